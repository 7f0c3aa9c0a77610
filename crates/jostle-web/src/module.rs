//! The simulations of a page, by number.

use jostle::{Error, Result};

use crate::shown::{SCENES, Shown};
use crate::text;

/// Work of one step, in units of `engine::WorkBudget`: about a second, in which the page does not answer. Its own steps take a
/// thousandth of that.
const MOST_WORK: u64 = 3_000_000;

/// Simulations by number, and the buffers through which the page talks with them.
#[derive(Default)]
pub struct Module {
    simulations: Vec<Option<Box<dyn Shown>>>,
    /// What the page says, and what it is told.
    pub text: Vec<u8>,
    /// Numbers for the page.
    pub numbers: Vec<f64>,
}

impl Module {
    /// Table of what there is: scene, engine, drive, fewest, most and usual number of disks, description; one a line, with tabs.
    pub fn scenes(&mut self) {
        self.text = text::scenes().into_bytes();
    }

    /// Starts the scene that the text describes, at time 0, and returns its number. Lines: `scene NAME`, `disks NUMBER`, then
    /// `PARAMETER VALUE`.
    ///
    /// # Errors
    /// A line, name or value that is not allowed.
    pub fn open(&mut self) -> Result<usize> {
        let given = String::from_utf8_lossy(&self.text).into_owned();
        let simulation = started(&given)?;
        let free = self.simulations.iter().position(Option::is_none);
        let number = free.unwrap_or_else(|| {
            self.simulations.push(None);
            self.simulations.len() - 1
        });
        self.simulations[number] = Some(simulation);
        Ok(number)
    }

    /// Ends the simulation of this number; nothing if there is none.
    pub fn close(&mut self, number: usize) {
        if let Some(simulation) = self.simulations.get_mut(number) {
            *simulation = None;
        }
    }

    /// Table of the variables: name, causality, kind, unit, smallest, largest and start value, value, options, description.
    ///
    /// # Errors
    /// No simulation of this number.
    pub fn variables(&mut self, number: usize) -> Result<()> {
        self.text = text::variables(&**self.simulation(number)?)?.into_bytes();
        Ok(())
    }

    /// What is doubtful about the parameters, one a line.
    ///
    /// # Errors
    /// No simulation of this number.
    pub fn warnings(&mut self, number: usize) -> Result<()> {
        let warnings = self.simulation(number)?.warnings();
        let lines: Vec<String> = warnings.into_iter().map(|warning| warning.text).collect();
        self.text = lines.join("\n").into_bytes();
        Ok(())
    }

    /// Advances to `time` \[s\].
    ///
    /// # Errors
    /// The step cannot be done, or there is no simulation of this number.
    pub fn advance(&mut self, number: usize, time: f64) -> Result<()> {
        self.simulation(number)?.advance_to(time)
    }

    /// Values of `count` variables from the one at `first` on, into the numbers.
    ///
    /// # Errors
    /// No such variables, or no simulation of this number.
    pub fn read(&mut self, number: usize, first: usize, count: usize) -> Result<()> {
        let simulation = self.simulation(number)?;
        let values: Result<Vec<f64>> = (first..first.saturating_add(count))
            .map(|position| simulation.value(position).map(|value| value.to_f64()))
            .collect();
        self.numbers = values?;
        Ok(())
    }

    /// The list `contacts` into the numbers, nine a contact.
    ///
    /// # Errors
    /// The engine has no lasting contacts, or there is no simulation of this number.
    pub fn contacts(&mut self, number: usize) -> Result<()> {
        self.numbers = self.simulation(number)?.list("contacts")?.numbers;
        Ok(())
    }

    fn simulation(&mut self, number: usize) -> Result<&mut Box<dyn Shown>> {
        let found = self.simulations.get_mut(number).and_then(Option::as_mut);
        found.ok_or_else(|| Error::call(format!("there is no simulation number {number}"), "Open one first."))
    }
}

/// The scene that these lines describe, at time 0.
fn started(given: &str) -> Result<Box<dyn Shown>> {
    let mut lines = given
        .lines()
        .filter(|line| !line.is_empty())
        .map(|line| line.split_once(' ').unwrap_or((line, "")));
    let scene = match lines.next() {
        Some(("scene", scene)) => scene,
        _ => {
            return Err(Error::call(
                "the first line names no scene",
                "Begin with: scene packing",
            ));
        }
    };
    let found = SCENES.iter().find(|known| (known.info)().name == scene);
    let found = found.ok_or_else(|| {
        let known = SCENES.map(|scene| (scene.info)().name).join(", ");
        Error::parameter("scene", scene, format!("one of: {known}"), "Name one of these.")
    })?;
    let lines: Vec<_> = lines.collect();
    let disks = lines.iter().find(|(name, _)| *name == "disks");
    let mut simulation = found.prepare(disks.map(|(_, number)| text::disks(number)).transpose()?)?;
    for (name, value) in lines.iter().filter(|(name, _)| *name != "disks") {
        simulation.set(name, value)?;
    }
    simulation.start()?;
    simulation.limit_work(MOST_WORK);
    Ok(simulation)
}

#[cfg(test)]
mod tests {
    use jostle::scene::packing::PackingOnSine;

    use super::*;

    fn opened(module: &mut Module, text: &str) -> Result<usize> {
        module.text = text.as_bytes().to_vec();
        module.open()
    }

    #[test]
    fn numbers_are_those_of_the_crate() {
        let mut module = Module::default();
        let number = opened(&mut module, "scene packing\ndisks 12\ndrive.amplitude 1e-4\n").unwrap();
        module.advance(number, 0.1).unwrap();
        module.advance(number, 0.2).unwrap();
        let given = [("drive.amplitude", 1e-4.into())];
        let mut typed = jostle::scene::Simulation::<PackingOnSine>::new(&[("disks", 12)], &given).unwrap();
        typed.advance_to(0.2).unwrap();
        let position = typed.position("disk.x[1]").unwrap();
        module.read(number, position, 12).unwrap();
        let expected: Vec<f64> = (position..position + 12)
            .map(|position| typed.value(position).unwrap().to_f64())
            .collect();
        assert_eq!(module.numbers, expected);
        module.contacts(number).unwrap();
        assert_eq!(module.numbers, typed.list("contacts").unwrap().numbers);
    }

    #[test]
    fn numbers_of_closed_simulations_are_used_again() {
        let mut module = Module::default();
        let numbers = [(); 3].map(|()| opened(&mut module, "scene wedge").unwrap());
        assert_eq!(numbers, [0, 1, 2]);
        module.close(1);
        module.close(99);
        assert!(
            module
                .advance(1, 0.1)
                .unwrap_err()
                .to_string()
                .contains("no simulation number 1")
        );
        assert_eq!(opened(&mut module, "scene ratchet\ndisks 5"), Ok(1));
    }

    #[test]
    fn what_is_wrong_is_told_by_name() {
        let mut module = Module::default();
        let mut message = |text: &str| opened(&mut module, text).unwrap_err().to_string();
        assert!(message("").contains("Begin with: scene packing"));
        assert!(message("scene sandpile").contains("one of: packing, ratchet, wedge"));
        assert!(message("scene packing\ndisks many").contains("disks = many"));
        assert!(message("scene packing\ndisks 0").contains("number of disks = 0"));
        assert!(message("scene packing\nglue 1").contains("no variable glue"));
        assert!(message("scene packing\ngravity -1").contains("gravity = -1"));
    }

    #[test]
    fn tables_have_a_line_for_each() {
        let mut module = Module::default();
        module.scenes();
        let text = String::from_utf8(module.text.clone()).unwrap();
        assert_eq!(text.lines().count(), 3);
        assert!(
            text.starts_with("packing\tmolecular-dynamics\tsine\t1\t100000\t60\t"),
            "{text}"
        );
        let number = opened(&mut module, "scene packing\ndisks 2").unwrap();
        module.variables(number).unwrap();
        let text = String::from_utf8(module.text.clone()).unwrap();
        let friction = text
            .lines()
            .find(|line| line.starts_with("contact.friction\t"))
            .unwrap();
        assert!(
            friction.starts_with("contact.friction\tparameter\treal\t1\t0\t1e6\t0.1\t0.1\t\t"),
            "{friction}"
        );
        assert!(text.lines().all(|line| line.split('\t').count() == 10));
    }
}
