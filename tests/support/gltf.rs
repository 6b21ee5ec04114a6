//! A small glTF file, made of what a test asks for.
#![allow(dead_code, reason = "each test binary takes what it needs")]

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// A file under construction: its buffer, and the accessors into it, each with a view of its own.
#[derive(Default)]
pub(crate) struct Gltf {
    pub(crate) bytes: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
}

impl Gltf {
    /// Adds an accessor; returns its index.
    pub(crate) fn accessor(&mut self, kind: u32, shape: &str, count: usize, bytes: &[u8]) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view =
            format!(r#"{{"buffer": 0, "byteOffset": {start}, "byteLength": {}}}"#, bytes.len());
        let accessor = format!(
            r#"{{"bufferView": {}, "componentType": {kind}, "type": "{shape}", "count": {count}}}"#,
            self.views.len()
        );
        self.views.push(view);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// An accessor of floats.
    pub(crate) fn floats(&mut self, shape: &str, count: usize, values: &[f32]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(5126, shape, count, &bytes)
    }

    /// The JSON with `uri` as that of the buffer, and these members beside the lists.
    pub(crate) fn json(&self, uri: Option<&str>, members: &str) -> String {
        let uri = uri.map_or_else(String::new, |uri| format!(r#", "uri": "{uri}""#));
        format!(
            "{{\"asset\": {{\"version\": \"2.0\"}},\n\"buffers\": [{{\"byteLength\": {}{uri}}}],\n\
             \"bufferViews\": [{}],\n\"accessors\": [{}],\n{members}}}",
            self.bytes.len(),
            self.views.join(",\n"),
            self.accessors.join(",\n")
        )
    }

    /// A text with its data inside.
    pub(crate) fn text(&self, members: &str) -> String {
        let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&self.bytes));
        self.json(Some(&uri), members)
    }

    /// A binary file.
    pub(crate) fn binary(&self, members: &str) -> Vec<u8> {
        let mut json = self.json(None, members).into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut file = b"glTF\x02\0\0\0".to_vec();
        let chunks = [(json.as_slice(), b"JSON"), (self.bytes.as_slice(), b"BIN\0")];
        let whole: usize = 12 + chunks.iter().map(|(chunk, _)| 8 + chunk.len()).sum::<usize>();
        file.extend(u32::try_from(whole).unwrap().to_le_bytes());
        for (chunk, kind) in chunks {
            file.extend(u32::try_from(chunk.len()).unwrap().to_le_bytes());
            file.extend(kind);
            file.extend(chunk);
        }
        file
    }
}
