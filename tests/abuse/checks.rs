//! What must hold of every output, whatever was asked.

use jostle::scene::Value;

use super::trial::Observed;

pub fn check_outputs(values: &Observed) -> Result<(), String> {
    for (name, value) in values.iter() {
        if let Value::Real(real) = value
            && !real.is_finite()
        {
            return Err(format!("{name} = {real}"));
        }
    }
    Ok(())
}

/// How far disk and base may move \[m\] in the time that separates two numbers at `time` \[s\] apart: 1e-10 s after a million.
/// The speeds are the largest that the energy, the lightest disk and the drive allow; `base` \[m/s\] is that of an input.
fn place_at_resolution(values: &Observed, time: f64, base: f64) -> f64 {
    let radii = ["disk.radius_small", "disk.radius_medium", "disk.radius_large"];
    let smallest = radii
        .iter()
        .filter_map(|name| values.find(name))
        .fold(f64::INFINITY, f64::min);
    let density = values.find("disk.surface_density").unwrap_or(f64::INFINITY);
    let lightest = density * std::f64::consts::PI * smallest * smallest;
    let disk = (2.0 * values.real("energy.kinetic") / lightest).sqrt();
    let drive = ["drive.amplitude", "drive.frequency"].map(|name| values.find(name).unwrap_or(0.0));
    let base = base + std::f64::consts::TAU * drive[0] * drive[1] + values.find("base.velocity").unwrap_or(0.0).abs();
    f64::EPSILON * time.abs() * (disk + base)
}

/// Hard disks stay in the box, soft ones leave it by half a radius at most. `base_speed` \[m/s\] is the mean one of an input.
pub fn check_box(values: &Observed, disks: u32, time: f64, base_speed: f64) -> Result<(), String> {
    let Some(width) = values.find("box.width") else {
        return Ok(());
    };
    let soft = values.find("chosen_time_step").is_some();
    let base = values.real("base.position");
    let blur = place_at_resolution(values, time, base_speed);
    for disk in 1..=disks {
        let number = |name: &str| values.real(&format!("{name}[{disk}]"));
        let (x, y, radius) = (number("disk.x"), number("disk.y"), number("disk.radius"));
        let slack = if soft {
            0.5 * radius
        } else {
            1e-9 * radius + 1e-12 * (width + y.abs() + base.abs()) + blur
        };
        if x.abs() + radius > 0.5 * width + slack || y < base + radius - slack {
            return Err(format!(
                "disk {disk} of radius {radius} is at {x}, {y} with the base at {base}"
            ));
        }
    }
    Ok(())
}

pub fn check_energy(values: &Observed) -> Result<(), String> {
    let Some(residual) = values.find("energy.residual") else {
        return Ok(());
    };
    if values.find("chosen_time_step").is_some() {
        return Ok(());
    }
    let names = ["energy.kinetic", "energy.potential", "energy.input", "energy.lost"];
    let scale: f64 = names.iter().map(|name| values.real(name).abs()).sum();
    if residual.abs() > 1e-6 * scale {
        return Err(format!("energy.residual = {residual:e} beside {scale:e}"));
    }
    Ok(())
}
