//! The bytes of buffers: in the file itself, in text of the file, or in files beside it.

use std::borrow::Cow;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf_json::Root;
use percent_encoding::percent_decode_str;

use super::GltfError;
use super::node::look_up;

/// The buffers of a file, each read when it is first needed.
pub(super) struct Buffers<'a> {
    root: &'a Root,
    /// The binary chunk.
    blob: Option<&'a [u8]>,
    folder: &'a Path,
    read: Vec<Option<Cow<'a, [u8]>>>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(root: &'a Root, blob: Option<&'a [u8]>, folder: &'a Path) -> Self {
        Self { root, blob, folder, read: vec![None; root.buffers.len()] }
    }

    /// The bytes of a view, and how far its elements lie apart where it says so.
    pub(super) fn view(
        &mut self,
        view: usize,
        place: impl Fn() -> String,
    ) -> Result<(&[u8], Option<usize>), GltfError> {
        let found = look_up(&self.root.buffer_views, view, "bufferViews", place)?;
        let buffer = found.buffer.value();
        let bytes = self.buffer(buffer, || format!("bufferViews[{view}].buffer"))?;
        let start = found.byte_offset.unwrap_or_default().0;
        let end = u128::from(start) + u128::from(found.byte_length.0);
        let outside = GltfError::View { view, end, buffer, length: bytes.len() };
        let range = usize::try_from(start).ok().zip(usize::try_from(end).ok());
        let bytes = range.and_then(|(start, end)| bytes.get(start..end)).ok_or(outside)?;
        Ok((bytes, found.byte_stride.map(|stride| stride.0)))
    }

    fn buffer(&mut self, buffer: usize, place: impl Fn() -> String) -> Result<&[u8], GltfError> {
        let found = look_up(&self.root.buffers, buffer, "buffers", place)?;
        if self.read[buffer].is_none() {
            let bytes = self.bytes(buffer, found.uri.as_deref(), found.byte_length.0)?;
            let got = bytes.len() as u64;
            if got < found.byte_length.0 {
                return Err(GltfError::Cut { buffer, need: found.byte_length.0, got });
            }
            self.read[buffer] = Some(bytes);
        }
        Ok(self.read[buffer].as_deref().unwrap_or_default())
    }

    fn bytes(
        &self,
        buffer: usize,
        uri: Option<&str>,
        length: u64,
    ) -> Result<Cow<'a, [u8]>, GltfError> {
        let wrong = |why| GltfError::Source { buffer, why };
        let Some(uri) = uri else {
            let blob = self.blob.filter(|_| buffer == 0);
            let why = "there is no uri, and no binary chunk for it; export the file again";
            return blob.map(Cow::Borrowed).ok_or_else(|| wrong(why));
        };
        if let Some(data) = uri.strip_prefix("data:") {
            let data = data.split_once(',').filter(|(kind, _)| kind.ends_with(";base64"));
            let (_, data) = data.ok_or_else(|| wrong("the data of its uri is not base64"))?;
            let bytes = STANDARD.decode(data);
            let bytes = bytes
                .map_err(|_| wrong("the base64 of its uri has a wrong character or length"))?;
            return Ok(Cow::Owned(bytes));
        }
        let name = percent_decode_str(uri).decode_utf8();
        let name = name.map_err(|_| wrong("its uri is not UTF-8"))?;
        if uri.contains("://") || Path::new(&*name).is_absolute() {
            return Err(wrong(
                "its uri names no file beside this one; export the file with its data",
            ));
        }
        let path = self.folder.join(&*name);
        let mut bytes = Vec::new();
        // No more than it needs, whatever the file is.
        let read = File::open(&path).and_then(|file| file.take(length).read_to_end(&mut bytes));
        read.map_err(|source| GltfError::Io { buffer, path: path.display().to_string(), source })?;
        Ok(Cow::Owned(bytes))
    }
}
