fn main() -> std::process::ExitCode {
    fmi_bundle::main::<first_fmu::Dahlquist>()
}
