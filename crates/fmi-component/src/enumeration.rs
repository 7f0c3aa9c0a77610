//! Enumerations of Rust as options of a variable.

/// An `enum` whose variants are the options of a variable: derive it with
/// [`#[derive(Enumeration)]`](derive@crate::Enumeration).
///
/// ```
/// use fmi_component::Enumeration;
///
/// #[derive(Enumeration, Debug, Clone, Copy, PartialEq)]
/// enum Gear {
///     /// No torque is transferred.
///     Neutral,
///     /// Ratio 3.5.
///     First,
/// }
///
/// assert_eq!(Gear::First.number(), 2);
/// assert_eq!(Gear::of_number(1), Some(Gear::Neutral));
/// assert_eq!(Gear::OPTIONS[0], ("Neutral", "No torque is transferred."));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no type of a variable",
    label = "not a type of a variable",
    note = "write f64, f32, bool, String, Vec<u8>, a whole number of 8 to 64 bits, [f64; N], or an enum with \
            #[derive(Enumeration, Clone, Copy, PartialEq)]"
)]
pub trait Enumeration: Copy + PartialEq + Send + Sync + 'static {
    /// Name of the type in model descriptions.
    const NAME: &'static str;
    /// Names of the options with one sentence each; the first has the number 1.
    const OPTIONS: &'static [(&'static str, &'static str)];
    /// The options.
    const ALL: &'static [Self];

    /// Number of the option, the first being 1.
    fn number(self) -> i64;

    /// The option with this number.
    fn of_number(number: i64) -> Option<Self> {
        let index = usize::try_from(number).ok()?.checked_sub(1)?;
        Self::ALL.get(index).copied()
    }
}
