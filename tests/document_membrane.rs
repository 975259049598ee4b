//! Boundary value problems in files: written and read back, damaged, hostile.
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use spline_lab::document::{
    Content, Document, Edit, MembraneDisplay, MembranePreset, View, from_json, to_json,
};

fn file(preset: MembranePreset) -> String {
    let mut document = Document::new();
    let content = Content::Membrane { membrane: preset.membrane(), display: preset.display() };
    document.apply(&Edit::AddObject { name: preset.title().to_owned(), content }).unwrap();
    to_json(&document, &View::default())
}

#[test]
fn every_preset_is_read_back_as_it_was() {
    for preset in MembranePreset::ALL {
        let saved = from_json(&file(preset)).unwrap();
        let (membrane, display) = saved.document.objects()[0].membrane().unwrap();
        assert_eq!(*membrane, preset.membrane(), "{}", preset.title());
        assert_eq!(*display, preset.display(), "{}", preset.title());
        assert_eq!(to_json(&saved.document, &saved.view), file(preset), "{}", preset.title());
    }
}

#[test]
fn impossible_values_are_named_with_their_place() {
    let refused = |preset, from: &str, to: &str| {
        let text = file(preset);
        let bad = text.replacen(from, to, 1);
        assert_ne!(bad, text, "{from} stands in the file");
        from_json(&bad).unwrap_err().to_string()
    };
    use MembranePreset::{BookPatch, Channel, Disc, Mushroom};
    for (preset, from, to, expected) in [
        (Disc, "\"degree\": 2", "\"degree\": 9", "membrane.degree: the degree is 9"),
        (Disc, "\"load\": \"4\"", "\"load\": \"4 +\"", "membrane.load: load: at character"),
        (Disc, "\"diffusion\": 1", "\"diffusion\": 0", "membrane.diffusion"),
        (Disc, "\"reaction\": 0", "\"reaction\": -1", "membrane.reaction"),
        (Disc, "\"width\": 0.25", "\"width\": 0", "membrane.domain.width"),
        (Disc, "\"radius\": 1.0", "\"radius\": -1.0", "membrane.domain.parts: part 1"),
        (Mushroom, "\"union\"", "\"onion\"", "onion"),
        (Mushroom, "\"isolines\": 10", "\"isolines\": 1000", "membrane.display"),
        (BookPatch, "\"divisions\": 8", "\"divisions\": 100000", "divisions"),
        (BookPatch, "\"bottom\"", "\"below\"", "below"),
        (BookPatch, "\"divisions\": 8", "\"inflow\": 1, \"divisions\": 8", "only a channel has an inflow"),
        (BookPatch, "\"degrees\": [1, 2]", "\"degrees\": [2, 2]", "membrane.patch.knots[0]"),
        (Channel, "\"inflow\": 1", "\"wind\": 1", "wind"),
        (Channel, "\"channel\"", "\"tube\"", "tube"),
    ] {
        let message = refused(preset, from, to);
        assert!(message.contains(expected), "{from} to {to}: {message}");
    }
}

#[test]
fn a_byte_replaced_by_any_other_never_panics_and_what_loads_is_valid() {
    for preset in [MembranePreset::Mushroom, MembranePreset::BookPatch] {
        let original = file(preset);
        for index in (0..original.len()).filter(|index| original.is_char_boundary(*index)) {
            for replacement in [b'9', b'-', b'e', b'"', b'}', b','] {
                let mut bytes = original.clone().into_bytes();
                bytes[index] = replacement;
                let Ok(text) = String::from_utf8(bytes) else { continue };
                if let Ok(saved) = from_json(&text) {
                    let again = from_json(&to_json(&saved.document, &saved.view)).unwrap();
                    assert_eq!(again.document, saved.document, "byte {index}");
                }
            }
        }
    }
}

#[test]
fn a_display_beyond_its_limits_is_no_edit() {
    let mut document = from_json(&file(MembranePreset::Disc)).unwrap().document;
    let object = document.objects()[0].id;
    let display = MembraneDisplay { isolines: 61, ..MembraneDisplay::default() };
    let content = Content::Membrane { membrane: MembranePreset::Disc.membrane(), display };
    let error = document.apply(&Edit::SetContent { object, content, label: "Lines".to_owned() }).unwrap_err();
    assert_eq!(error.name(), "BadDisplay", "{error}");
}
