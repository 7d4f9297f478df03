//! Temperatures in another unit than degrees Celsius.

use super::{Remark, remark, suspicious};
use crate::identify::error::IdentifyError;
use crate::identify::measurements::{Measurement, Measurements};

/// No arm that is measured is hotter, °C: kelvin begin far above.
const HOTTEST_C: f64 = 120.0;
/// From here on half of the temperatures are those of a room in Fahrenheit (16 °C), and of an arm's
/// housings after hours of hard work in Celsius.
const WARM_C: f64 = 60.0;
/// No workshop is colder, kelvin.
const COLDEST_K: f64 = 220.0;
/// The melting point of ice, kelvin.
const ZERO_C_K: f64 = 273.15;

fn celsius(row: &Measurement) -> Option<f64> {
    row.conditions.temperature_c
}

/// Checks for temperatures that no arm has, or hardly any.
///
/// # Errors
/// One that no arm has.
pub(crate) fn check(measurements: &Measurements) -> Result<Option<Remark>, IdentifyError> {
    let rows = || {
        measurements
            .rows
            .iter()
            .filter_map(|row| Some((row, celsius(row)?)))
    };
    if let Some((row, hot)) = rows().find(|(_, celsius)| *celsius > HOTTEST_C) {
        let message = format!(
            "{}: temperature_c is {hot:.1}: no arm is hotter than {HOTTEST_C} degrees Celsius",
            row.line
        );
        let (unit, celsius) = if hot < COLDEST_K {
            ("Fahrenheit", of_fahrenheit(hot))
        } else {
            ("kelvin", hot - ZERO_C_K)
        };
        let hint = format!(
            "temperature_c is in degrees Celsius: is it in {unit} (then it is {celsius:.1})?"
        );
        return Err(suspicious(message, &hint));
    }
    let mut all: Vec<(&Measurement, f64)> = rows().collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    let Some((row, middle)) = all
        .get(all.len() / 2)
        .filter(|(_, middle)| *middle >= WARM_C)
    else {
        return Ok(None);
    };
    let message = format!(
        "temperature_c is {middle:.1} in the middle of the rows: few arms are as hot as that, and a \
         room of {:.1} degrees Celsius is in Fahrenheit",
        of_fahrenheit(*middle)
    );
    let hint = "temperature_c is in degrees Celsius: (F - 32) / 1.8";
    Ok(Some(remark(
        "temperature-unit",
        row.line.clone(),
        message,
        hint,
    )))
}

fn of_fahrenheit(fahrenheit: f64) -> f64 {
    (fahrenheit - 32.0) / 1.8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(temperatures: [f64; 3]) -> Result<Option<&'static str>, String> {
        let mut csv =
            "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,temperature_c\n".to_owned();
        for (k, celsius) in temperatures.iter().enumerate() {
            csv += &format!("{k},0,0,0,0,0,{k},0,0,{celsius}\n");
        }
        let rows = Measurements::from_csv(csv.as_bytes()).expect("a table");
        let found = check(&rows).map_err(|error| format!("{error} {}", error.hint()))?;
        Ok(found.map(|remark| remark.id))
    }

    #[test]
    fn kelvin_are_refused_and_fahrenheit_doubted() {
        assert_eq!(checked([18.0, 26.0, 41.0]), Ok(None));
        // one bearing runs hot
        assert_eq!(checked([41.0, 52.0, 75.0]), Ok(None));
        assert_eq!(checked([68.0, 70.5, 72.0]), Ok(Some("temperature-unit")));
        let kelvin = checked([293.1, 295.2, 296.0]).expect_err("no arm is so hot");
        for words in ["line 2", "293.1", "kelvin (then it is 20.0"] {
            assert!(kelvin.contains(words), "{kelvin}");
        }
    }
}
