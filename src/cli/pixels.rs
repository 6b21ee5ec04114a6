//! Pictures as PNG: those that a device drew, and those that commands draw.

use super::failure::Failure;
use super::heat::{BACKGROUND, Colour};
use super::output::write_whole;
use guardbit::explore::identify::Pixels;
use std::io::{BufRead, Seek};
use std::path::Path;

/// Most pixels that are read.
const MOST: u64 = 1 << 26;

/// Reads a PNG: a pixel is covered unless it is black or has the background of `render`. Alpha is no colour: what a
/// device drew in black is not seen, however opaque.
pub(crate) fn covered(file: impl BufRead + Seek) -> Result<Pixels, String> {
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let (width, height) = (reader.info().width, reader.info().height);
    if u64::from(width) * u64::from(height) > MOST {
        return Err(format!("{width} x {height}: a picture has at most 2^26 pixels"));
    }
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("the picture is too large")?];
    let frame = reader.next_frame(&mut bytes).map_err(|error| error.to_string())?;
    let channels = frame.color_type.samples();
    let colours = if channels % 2 == 0 { channels - 1 } else { channels };
    let is_covered = |pixel: &[u8]| {
        let colour = &pixel[..colours];
        colour != BACKGROUND && colour.iter().any(|part| *part > 0)
    };
    let rows = bytes.chunks_exact(frame.line_size.max(1)).take(height as usize);
    let pixels = rows.flat_map(|row| row.chunks_exact(channels).take(width as usize));
    Ok((pixels.map(is_covered).collect(), (width, height)))
}

/// Writes a picture of so many columns, each pixel enlarged to a square of `zoom`, and below it rows that are not.
pub(crate) fn write(
    path: &Path,
    (pixels, width): (&[Colour], u32),
    zoom: u32,
    below: &[Colour],
) -> Result<(), Failure> {
    let (times, wide) = (zoom as usize, (width * zoom) as usize);
    let mut data = Vec::with_capacity(3 * (pixels.len() * times * times + below.len()));
    for row in pixels.chunks_exact(width as usize) {
        let first = data.len();
        for colour in row {
            for _ in 0..times {
                data.extend_from_slice(colour);
            }
        }
        for _ in 1..times {
            data.extend_from_within(first..first + 3 * wide);
        }
    }
    data.extend_from_slice(below.as_flattened());
    let high = u32::try_from(data.len() / 3 / wide.max(1)).unwrap_or(u32::MAX);
    write_whole(path, |file| {
        let mut encoder = png::Encoder::new(file, width * zoom, high);
        encoder.set_color(png::ColorType::Rgb);
        let mut writer = encoder.write_header().map_err(std::io::Error::other)?;
        writer.write_image_data(&data).map_err(std::io::Error::other)?;
        writer.finish().map_err(std::io::Error::other)
    })
}
