//! FMUs of one model that were made on different systems in, one FMU with all their libraries out.
//!
//! They must be of one model description, one reference trajectory and one set of licences: only the date and the libraries may
//! differ. Date and order of the files are those of the first.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use fmi_component::{Error, Result, Version};

use crate::archive::{self, Member};
use crate::bundle::write_file;
use crate::documentation;
use crate::libraries::Libraries;
use crate::platform::Platform;
use crate::replay::Description;

const DESCRIPTION: &str = "modelDescription.xml";
const ONE_SOURCE: &str = "Write both FMUs by the same version of the same program, with the same options.";

/// An FMU that is to be merged.
struct Part {
    file: PathBuf,
    description: Description,
    /// All but the libraries, in their order.
    members: Vec<Member>,
    /// Path in the archive and bytes of each library.
    binaries: Vec<(Platform, Member)>,
}

/// Joins the FMUs `parts` into `out`, which may be one of them; the platforms of its libraries.
///
/// # Errors
/// Fewer than two FMUs; one that cannot be read; FMUs that differ in more than date and libraries, by the name of what differs; a
/// library in the folder of another system; two libraries for one system with different bytes; `out` cannot be written.
pub fn merge(parts: &[PathBuf], out: &Path) -> Result<Vec<Platform>> {
    let read = parts.iter().map(|file| Part::read(file)).collect::<Result<Vec<_>>>()?;
    let [first, others @ ..] = read.as_slice() else {
        return Err(Error::call("no FMU is named", "Name two or more."));
    };
    if others.is_empty() {
        return Err(Error::call(
            format!("{} alone has nothing to be merged with", first.file.display()),
            "Name two or more FMUs.",
        ));
    }
    let (mut libraries, mut paths) = (Libraries::default(), BTreeMap::new());
    for part in &read {
        first.check_same(part)?;
        for (platform, member) in &part.binaries {
            libraries.add(&part.file.join(&member.path), member.bytes.clone())?;
            paths.insert(*platform, member.path.clone());
        }
    }
    let table = documentation::libraries(libraries.iter());
    let mut members = first.members.clone();
    if let Some(page) = members.iter_mut().find(|member| member.path == documentation::PATH) {
        page.bytes = documentation::with_libraries(&String::from_utf8_lossy(&page.bytes), &table).into_bytes();
    }
    let binary = |(platform, bytes): (Platform, &[u8])| {
        Some(Member {
            path: paths.get(&platform)?.clone(),
            bytes: bytes.into(),
        })
    };
    members.extend(libraries.iter().filter_map(binary));
    write_file(out, &archive::write(&members)?)?;
    Ok(paths.into_keys().collect())
}

impl Part {
    fn read(file: &Path) -> Result<Self> {
        let unfit = |what: String| Error::file(file, what, "Name an FMU that this crate wrote.");
        let bytes = fs::read(file).map_err(|error| Error::file(file, error, "Name an FMU."))?;
        let members = archive::read(&bytes).map_err(unfit)?;
        let (binaries, members): (Vec<_>, Vec<_>) = members
            .into_iter()
            .partition(|member| member.path.starts_with("binaries/"));
        let text = members.iter().find(|member| member.path == DESCRIPTION);
        let text = text.ok_or_else(|| unfit(format!("it holds no {DESCRIPTION}")))?;
        let description = Description::read(&String::from_utf8_lossy(&text.bytes));
        let description = description.map_err(|what| unfit(format!("{DESCRIPTION}: {what}")))?;
        let binaries = binaries.into_iter().map(|member| {
            let platform = check_place(file, &member, &description)?;
            Ok((platform, member))
        });
        let binaries = binaries.collect::<Result<_>>()?;
        Ok(Self {
            file: file.into(),
            description,
            members,
            binaries,
        })
    }

    /// Refuses `other` if anything but its date and its libraries differs from this one.
    fn check_same(&self, other: &Self) -> Result<()> {
        let differs = |what: String| Error::file(&other.file, what, ONE_SOURCE);
        let first = self.file.display();
        let names = |version| if version == Version::Two { "FMI 2.0" } else { "FMI 3.0" };
        let (ours, theirs) = (&self.description, &other.description);
        for (what, ours, theirs) in [
            ("the standard", names(ours.version), names(theirs.version)),
            (
                "the model identifier",
                ours.identifier.as_str(),
                theirs.identifier.as_str(),
            ),
            ("the instantiation token", ours.token.as_str(), theirs.token.as_str()),
        ] {
            if ours != theirs {
                return Err(differs(format!("{what} is {theirs:?}, in {first} it is {ours:?}")));
            }
        }
        // The page last: it shows what the other files hold, and says less of it.
        let mut members: Vec<&Member> = self.members.iter().collect();
        members.sort_by_key(|member| member.path == documentation::PATH);
        for member in members {
            let Some(twin) = other.members.iter().find(|twin| twin.path == member.path) else {
                return Err(differs(format!("it lacks {}, which {first} holds", member.path)));
            };
            if let Some((number, ours, theirs)) = first_difference(member, twin) {
                let path = &member.path;
                return Err(differs(format!(
                    "line {number} of {path} is {theirs:?}, in {first} it is {ours:?}"
                )));
            }
        }
        match other
            .members
            .iter()
            .find(|theirs| !self.members.iter().any(|ours| ours.path == theirs.path))
        {
            Some(member) => Err(differs(format!("it holds {}, which {first} lacks", member.path))),
            None => Ok(()),
        }
    }
}

/// The system that a library in an FMU is for, if it is in the folder of that system and has its name.
fn check_place(file: &Path, member: &Member, description: &Description) -> Result<Platform> {
    let path = file.join(&member.path);
    let platform = Platform::of_library(&member.bytes)
        .map_err(|what| Error::file(&path, what, "Write the FMU anew with a shared library."))?;
    let expected = platform
        .folder(description.version)
        .map(|folder| format!("binaries/{folder}/{}{}", description.identifier, platform.suffix()));
    match expected {
        Some(expected) if expected == member.path => Ok(platform),
        expected => {
            let place = expected.unwrap_or_else(|| "no place in FMI 2.0".into());
            Err(Error::file(
                &path,
                format!("it is a library for {platform}, which has {place}"),
                "Write the FMU anew.",
            ))
        }
    }
}

/// Number and text of the first line that differs between two files, without date and libraries.
fn first_difference(ours: &Member, theirs: &Member) -> Option<(usize, String, String)> {
    if ours.bytes == theirs.bytes {
        return None;
    }
    let [ours, theirs] = [ours, theirs].map(|member| {
        let text = String::from_utf8_lossy(&member.bytes).into_owned();
        match member.path.as_str() {
            DESCRIPTION => without_date(&text),
            documentation::PATH => documentation::without_build(&text),
            _ => text,
        }
    });
    let (mut ours, mut theirs) = (ours.lines(), theirs.lines());
    (1..).find_map(|number| match (ours.next(), theirs.next()) {
        (None, None) => Some(None),
        (ours, theirs) if ours == theirs => None,
        (ours, theirs) => Some(Some((
            number,
            ours.unwrap_or_default().into(),
            theirs.unwrap_or_default().into(),
        ))),
    })?
}

/// A model description without the date at which it was written.
fn without_date(text: &str) -> String {
    const BEGIN: &str = " generationDateAndTime=\"";
    let parts = text
        .split_once(BEGIN)
        .and_then(|(head, rest)| Some((head, rest.split_once('"')?.1)));
    parts.map_or_else(|| text.into(), |(head, tail)| [head, tail].concat())
}
