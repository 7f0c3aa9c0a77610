//! Files that have the header of a shared library, by the layouts that their formats publish, and no code.

use fmi_bundle::{Libraries, Platform};

/// A library for `platform`; `mark` makes it differ from others.
pub fn library(platform: Platform, mark: &str) -> Vec<u8> {
    let mut bytes = match platform {
        Platform::X86Linux => elf(62, 3),
        Platform::ArmLinux => elf(183, 3),
        Platform::X86Windows => pe(0x8664),
        Platform::ArmWindows => pe(0xaa64),
        Platform::X86Darwin => mach_o(0x0100_0007),
        Platform::ArmDarwin => mach_o(0x0100_000c),
    };
    bytes.extend(mark.as_bytes());
    bytes
}

/// One for each of `platforms`.
pub fn libraries(platforms: &[Platform]) -> Libraries {
    let mut libraries = Libraries::default();
    for platform in platforms {
        libraries.add(platform.name().as_ref(), library(*platform, "")).unwrap();
    }
    libraries
}

/// ELF of 64 bits for `machine`, without segments and sections; `kind` 3 is a shared library, 2 a program.
pub fn elf(machine: u16, kind: u16) -> Vec<u8> {
    let mut bytes = vec![0x7f, b'E', b'L', b'F', 2, 1, 1];
    bytes.resize(16, 0);
    for half in [kind, machine, 1, 0] {
        bytes.extend(half.to_le_bytes());
    }
    bytes.resize(52, 0);
    for half in [64_u16, 56, 0, 64, 0, 0] {
        bytes.extend(half.to_le_bytes());
    }
    bytes
}

/// PE32+ for `machine`, a DLL without sections and directories.
fn pe(machine: u16) -> Vec<u8> {
    let mut bytes = b"MZ".to_vec();
    bytes.resize(60, 0);
    bytes.extend(64_u32.to_le_bytes());
    bytes.extend(b"PE\0\0");
    bytes.extend(machine.to_le_bytes());
    bytes.resize(84, 0);
    bytes.extend(112_u16.to_le_bytes()); // length of what follows the next two bytes
    bytes.extend(0x2022_u16.to_le_bytes()); // a DLL that may lie anywhere
    bytes.extend(0x20b_u16.to_le_bytes());
    bytes.resize(88 + 112, 0);
    bytes
}

/// Mach-O of 64 bits for the processor `cpu`, a dynamic library without commands.
fn mach_o(cpu: u32) -> Vec<u8> {
    let words = [0xfeed_facf, cpu, 0, 6, 0, 0, 0, 0];
    words.iter().flat_map(|word: &u32| word.to_le_bytes()).collect()
}
