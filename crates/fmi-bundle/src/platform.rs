//! Systems that a library can be for, as each standard names them, and which one a library is for by its own header.

use std::env::consts::{ARCH, OS};
use std::fmt;

use fmi_component::Version;
use object::{Architecture, BinaryFormat, FileKind, Object, ObjectKind};

/// A processor with an operating system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Platform {
    /// Linux on x86-64.
    X86Linux,
    /// Linux on 64-bit Arm.
    ArmLinux,
    /// Windows on x86-64.
    X86Windows,
    /// Windows on 64-bit Arm.
    ArmWindows,
    /// macOS on x86-64.
    X86Darwin,
    /// macOS on 64-bit Arm.
    ArmDarwin,
}

impl Platform {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::X86Linux,
        Self::ArmLinux,
        Self::X86Windows,
        Self::ArmWindows,
        Self::X86Darwin,
        Self::ArmDarwin,
    ];

    /// The one that this program runs on; none if it is not one of [`Platform::ALL`].
    pub fn host() -> Option<Self> {
        let system = if OS == "macos" { "darwin" } else { OS };
        Self::from_name(&format!("{ARCH}-{system}"))
    }

    /// The one that FMI 3.0 calls `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|platform| platform.name() == name)
    }

    /// Name in FMI 3.0, which is that of its folder there.
    pub fn name(self) -> &'static str {
        match self {
            Self::X86Linux => "x86_64-linux",
            Self::ArmLinux => "aarch64-linux",
            Self::X86Windows => "x86_64-windows",
            Self::ArmWindows => "aarch64-windows",
            Self::X86Darwin => "x86_64-darwin",
            Self::ArmDarwin => "aarch64-darwin",
        }
    }

    /// Folder of its library in `binaries/`; none for 64-bit Arm in FMI 2.0, which has no name for that.
    pub fn folder(self, version: Version) -> Option<&'static str> {
        match (version, self) {
            (Version::Three, _) => Some(self.name()),
            (Version::Two, Self::X86Linux) => Some("linux64"),
            (Version::Two, Self::X86Windows) => Some("win64"),
            (Version::Two, Self::X86Darwin) => Some("darwin64"),
            (Version::Two, Self::ArmLinux | Self::ArmWindows | Self::ArmDarwin) => None,
        }
    }

    /// End of the name of its libraries, such as `.so`.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::X86Linux | Self::ArmLinux => ".so",
            Self::X86Windows | Self::ArmWindows => ".dll",
            Self::X86Darwin | Self::ArmDarwin => ".dylib",
        }
    }

    /// What the header of a shared library says that it is for.
    ///
    /// # Errors
    /// It is no shared library, or one for another system; the text says what it is.
    pub fn of_library(bytes: &[u8]) -> Result<Self, String> {
        if let Ok(FileKind::MachOFat32 | FileKind::MachOFat64) = FileKind::parse(bytes) {
            return Err("it is a universal library of macOS: take one of its parts by lipo -thin".into());
        }
        let file = object::File::parse(bytes).map_err(|error| format!("it is no library: {error}"))?;
        let (format, processor) = (file.format(), file.architecture());
        if file.kind() != ObjectKind::Dynamic {
            return Err(format!("it is no shared library but of kind {:?}", file.kind()));
        }
        match (format, processor) {
            (BinaryFormat::Elf, Architecture::X86_64) => Ok(Self::X86Linux),
            (BinaryFormat::Elf, Architecture::Aarch64) => Ok(Self::ArmLinux),
            (BinaryFormat::Pe, Architecture::X86_64) => Ok(Self::X86Windows),
            (BinaryFormat::Pe, Architecture::Aarch64) => Ok(Self::ArmWindows),
            (BinaryFormat::MachO, Architecture::X86_64) => Ok(Self::X86Darwin),
            (BinaryFormat::MachO, Architecture::Aarch64) => Ok(Self::ArmDarwin),
            _ => Err(format!("it is a library for {processor:?} in the format {format:?}")),
        }
    }
}

impl fmt::Display for Platform {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}
