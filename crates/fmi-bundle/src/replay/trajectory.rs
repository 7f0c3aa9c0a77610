//! The reference trajectory of an FMU, read back.

/// Names of the columns, the first being the time, and the rows; none where the model refuses its start values.
pub struct Trajectory {
    pub names: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Trajectory {
    /// Reads the CSV.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let mut reader = csv::Reader::from_reader(bytes);
        let header = reader.headers().map_err(|error| error.to_string())?;
        let names: Vec<String> = header.iter().map(String::from).collect();
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| error.to_string())?;
            let row: Result<Vec<f64>, _> = record.iter().map(str::parse).collect();
            rows.push(row.map_err(|error| error.to_string())?);
        }
        if names.first().is_none_or(|name| name != "time") {
            return Err("its first column is not the time".into());
        }
        Ok(Self { names, rows })
    }

    /// Largest absolute value in the column at `index`.
    pub fn largest(&self, index: usize) -> f64 {
        self.rows.iter().map(|row| row[index].abs()).fold(0.0, f64::max)
    }
}
