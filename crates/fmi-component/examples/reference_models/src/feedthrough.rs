//! Every type: outputs follow inputs of all types of FMI 3.0; FMI 2.0 has them all but the binary ones.

use fmi_component::{CoSimulation, Component, Enumeration, Result, Step};

/// Options of the enumeration.
#[derive(Enumeration, Debug, Clone, Copy, PartialEq)]
#[enumeration(name = "Option")]
pub enum Choice {
    /// First option.
    #[enumeration(name = "Option 1")]
    First,
    /// Second option.
    #[enumeration(name = "Option 2")]
    Second,
}

/// Passes the values of its inputs to its outputs in each step.
#[derive(Component)]
#[component(stop_time = 2.0, step_size = 0.1)]
#[rustfmt::skip]
#[allow(non_snake_case)] // the names are those of the Reference FMU
pub struct Feedthrough {
    #[parameter(start = 0)] Float64_fixed_parameter: f64,
    #[parameter(start = 0, tunable)] Float64_tunable_parameter: f64,
    #[input] Float32_continuous_input: f32,
    #[output] Float32_continuous_output: f32,
    #[input(discrete)] Float32_discrete_input: f32,
    #[output(discrete)] Float32_discrete_output: f32,
    #[input] Float64_continuous_input: f64,
    #[output] Float64_continuous_output: f64,
    #[input(discrete)] Float64_discrete_input: f64,
    #[output(discrete)] Float64_discrete_output: f64,
    #[input] Int8_input: i8,
    #[output] Int8_output: i8,
    #[input] UInt8_input: u8,
    #[output] UInt8_output: u8,
    #[input] Int16_input: i16,
    #[output] Int16_output: i16,
    #[input] UInt16_input: u16,
    #[output] UInt16_output: u16,
    #[input] Int32_input: i32,
    #[output] Int32_output: i32,
    #[input] UInt32_input: u32,
    #[output] UInt32_output: u32,
    #[input] Int64_input: i64,
    #[output] Int64_output: i64,
    #[input] UInt64_input: u64,
    #[output] UInt64_output: u64,
    #[input] Boolean_input: bool,
    #[output] Boolean_output: bool,
    #[input(start = "Set me!")] String_input: String,
    #[output] String_output: String,
    #[input(start = b"foo")] Binary_input: Vec<u8>,
    #[output] Binary_output: Vec<u8>,
    #[input(start = Choice::First)] Enumeration_input: Choice,
    #[output] Enumeration_output: Choice,
}

impl Feedthrough {
    fn pass(&mut self) {
        self.Float32_continuous_output = self.Float32_continuous_input;
        self.Float32_discrete_output = self.Float32_discrete_input;
        let parameters = self.Float64_fixed_parameter + self.Float64_tunable_parameter;
        self.Float64_continuous_output = parameters + self.Float64_continuous_input;
        self.Float64_discrete_output = self.Float64_discrete_input;
        self.Int8_output = self.Int8_input;
        self.UInt8_output = self.UInt8_input;
        self.Int16_output = self.Int16_input;
        self.UInt16_output = self.UInt16_input;
        self.Int32_output = self.Int32_input;
        self.UInt32_output = self.UInt32_input;
        self.Int64_output = self.Int64_input;
        self.UInt64_output = self.UInt64_input;
        self.Boolean_output = self.Boolean_input;
        self.String_output.clone_from(&self.String_input);
        self.Binary_output.clone_from(&self.Binary_input);
        self.Enumeration_output = self.Enumeration_input;
    }
}

impl CoSimulation for Feedthrough {
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        self.pass();
        Ok(())
    }

    fn do_step(&mut self, _step: &mut Step) -> Result<()> {
        self.pass();
        Ok(())
    }
}
