//! TOML texts and settings that nobody writes: refused with a text, in bounded time and stack.
#![allow(unsafe_code, clippy::unwrap_used, clippy::undocumented_unsafe_blocks)]

use std::ffi::CString;

use jostle_c::{JostleSetting, jostle_free, jostle_new, jostle_new_from_toml};
use proptest::prelude::*;

fn from_toml(text: &str) -> String {
    let toml = CString::new(text.replace('\0', "?")).unwrap();
    let mut message = vec![0_u8; 4096];
    unsafe {
        let made = jostle_new_from_toml(toml.as_ptr(), message.as_mut_ptr().cast(), message.len());
        assert!(
            !made.is_null() || message[0] != 0,
            "neither a simulation nor a text: {text:?}"
        );
        jostle_free(made);
    }
    let end = message.iter().position(|&byte| byte == 0).unwrap();
    String::from_utf8(message[..end].to_vec()).unwrap()
}

#[test]
fn deep_and_long_texts_are_refused() {
    let deep = |open: &str, shut: &str| {
        format!(
            "scene = 'wedge'\nparameters.seed = {}1{}",
            open.repeat(100_000),
            shut.repeat(100_000)
        )
    };
    let keys = format!("scene = 'wedge'\nparameters.{}x = 1", "a.".repeat(100_000));
    let tables = format!("scene = 'wedge'\n[parameters.{}x]\ny = 1", "a.".repeat(100_000));
    for text in [deep("[", "]"), deep("{a=", "}"), keys, tables, "x".repeat(1 << 20)] {
        assert!(!from_toml(&text).is_empty());
    }
}

proptest! {
    #[test]
    fn any_text_is_accepted_or_refused_with_a_message(text in "\\PC{0,200}") {
        from_toml(&text);
    }

    #[test]
    fn any_setting_is_accepted_or_refused_with_a_message(name in "\\PC{0,40}", value in "\\PC{0,40}", known in 0..5_usize) {
        let known = ["seed", "gravity", "disk.radius", "drive.amplitude", "disk.angle[1]"].get(known);
        let name = CString::new(known.map_or(name, |known| known.to_string()).replace('\0', "?")).unwrap();
        let value = CString::new(value.replace('\0', "?")).unwrap();
        let setting = JostleSetting { name: name.as_ptr(), value: value.as_ptr() };
        let mut message = [0_u8; 512];
        unsafe {
            let scene = c"wedge".as_ptr();
            let (none, text) = (std::ptr::null(), message.as_mut_ptr().cast());
            let made = jostle_new(scene, none, none, 0, &setting, 1, text, message.len());
            prop_assert!(!made.is_null() || message[0] != 0);
            jostle_free(made);
        }
    }
}
