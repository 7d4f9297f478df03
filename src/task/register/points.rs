//! Tables of points and of probe touches, and which of them belong together.

use crate::geometry::units::m_from_mm;
use crate::geometry::{Vector, norm, scale};
use crate::program::Source;
use crate::task::failure::Failure;
use crate::task::table::{Row, Table};
use std::collections::BTreeMap;

/// Columns of a position.
pub(crate) const POINT: [&str; 3] = ["x_mm", "y_mm", "z_mm"];
/// Columns of an outward normal.
pub(crate) const NORMAL: [&str; 3] = ["nx", "ny", "nz"];

/// What a row stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Feature {
    Point,
    Sphere,
    Hole,
    Plane,
}

/// One row.
#[derive(Clone, Debug)]
pub(crate) struct PointRow {
    pub id: String,
    pub point_m: Vector,
    pub normal: Option<Vector>,
    pub feature: Feature,
    pub radius_m: Option<f64>,
    pub sigma_m: Option<f64>,
    pub weight: Option<f64>,
    /// The datum touched, from 0, or what stands in its cell instead: read for a 3-2-1 frame only.
    pub datum: Option<Result<usize, Failure>>,
}

/// A table of points.
pub(crate) struct Points {
    pub name: String,
    pub rows: Vec<PointRow>,
    pub has_ids: bool,
}

impl Points {
    pub(crate) fn read(source: &Source) -> Result<Self, Failure> {
        let table = Table::read(source)?;
        table.require(&POINT)?;
        let optional = |column: &'static str| -> Result<_, Failure> {
            Ok(table.group(&[column])?.then_some(column))
        };
        let (radius, sigma, weight) = (
            optional("radius_mm")?,
            optional("sigma_mm")?,
            optional("weight")?,
        );
        for column in ["id", "feature", "datum"] {
            optional(column)?;
        }
        let has_normals = table.group(&NORMAL)?;
        let mut rows = Vec::new();
        for (number, row) in table.rows().enumerate() {
            let feature = match row.text("feature").unwrap_or("point") {
                "" | "point" => Feature::Point,
                "sphere" => Feature::Sphere,
                "hole" => Feature::Hole,
                "plane" => Feature::Plane,
                other => {
                    return Err(row.failure(format!(
                        "feature `{other}` is not one of point, sphere, hole, plane"
                    )));
                }
            };
            // a feature without a normal or radius leaves the cells empty
            let filled = |column: &str| row.text(column).is_some_and(|text| !text.is_empty());
            let normal = if has_normals && NORMAL.iter().any(|c| filled(c)) {
                let n = row.numbers(NORMAL)?;
                let length = norm(n);
                if (length - 1.0).abs() > 1e-2 {
                    return Err(
                        row.failure(format!("the normal's length is {length:.4}; it must be 1"))
                    );
                }
                Some(scale(1.0 / length, n))
            } else {
                None
            };
            let number_in = |column: Option<&str>| match column.filter(|c| filled(c)) {
                Some(column) => row.number(column).map(Some),
                None => Ok(None),
            };
            let sigma_mm = number_in(sigma)?;
            if sigma_mm.is_some_and(|s| s <= 0.0) {
                return Err(row.failure("sigma_mm must be above 0".into()));
            }
            rows.push(PointRow {
                id: row.id(number + 1),
                point_m: row.numbers(POINT)?.map(m_from_mm),
                normal,
                feature,
                radius_m: number_in(radius)?.map(m_from_mm),
                sigma_m: sigma_mm.map(m_from_mm),
                weight: number_in(weight)?,
                datum: filled("datum").then(|| datum(&row)),
            });
        }
        let has_ids = table.has("id");
        table.refuse_misspelt()?;
        Ok(Self {
            name: source.name.clone(),
            rows,
            has_ids,
        })
    }

    /// The positions in order, metres.
    pub(crate) fn positions(&self) -> Vec<Vector> {
        self.rows.iter().map(|row| row.point_m).collect()
    }
}

/// The datum that a cell names, from 0.
fn datum(row: &Row) -> Result<usize, Failure> {
    let number = row.number("datum")?;
    let known = [1.0, 2.0, 3.0].iter().position(|datum| *datum == number);
    known.ok_or_else(|| {
        let message = format!(
            "column datum: {number} is not 1 (primary), 2 (secondary) or 3 (tertiary datum)"
        );
        row.failure_in("datum", message)
    })
}

/// A row of FROM and the rows of TO that measure it.
pub(crate) struct Pair<'a> {
    pub from: &'a PointRow,
    pub to: Vec<&'a PointRow>,
}

/// Matches by `id` where both tables have one, else by order. Rows without a partner are an error
/// unless `drop` allows them; then their ids are returned.
pub(crate) fn matched<'a>(
    from: &'a Points,
    to: &'a Points,
    drop: bool,
) -> Result<(Vec<Pair<'a>>, Vec<String>), Failure> {
    if !(from.has_ids && to.has_ids) {
        if from.rows.len() != to.rows.len() {
            let message = format!(
                "{} has {} points and {} has {}: rows are matched in order",
                from.name,
                from.rows.len(),
                to.name,
                to.rows.len()
            );
            let hint =
                "give both files a column id and rows are matched by it; --icp needs no matching";
            return Err(Failure::with_hint(message, hint));
        }
        let pairs = from.rows.iter().zip(&to.rows);
        return Ok((
            pairs
                .map(|(from, to)| Pair { from, to: vec![to] })
                .collect(),
            Vec::new(),
        ));
    }
    let mut touches: BTreeMap<&str, Vec<&PointRow>> = BTreeMap::new();
    for row in &to.rows {
        touches.entry(&row.id).or_default().push(row);
    }
    let (mut pairs, mut lonely) = (Vec::new(), Vec::new());
    let mut seen = std::collections::BTreeSet::new();
    for row in &from.rows {
        if !seen.insert(row.id.as_str()) {
            return Err(Failure::new(format!(
                "{}: the id `{}` stands twice",
                from.name, row.id
            )));
        }
        match touches.remove(row.id.as_str()) {
            None => lonely.push(format!("{} ({})", row.id, from.name)),
            Some(to_rows) => {
                if row.feature == Feature::Point && to_rows.len() > 1 {
                    return Err(Failure::with_hint(
                        format!("{}: the id `{}` stands twice", to.name, row.id),
                        "several touches of one feature need feature sphere, hole or plane in FROM",
                    ));
                }
                pairs.push(Pair {
                    from: row,
                    to: to_rows,
                });
            }
        }
    }
    let rest = touches.keys().map(|id| format!("{id} ({})", to.name));
    lonely.extend(rest);
    if !lonely.is_empty() && !drop {
        let shown = lonely.iter().take(8).cloned().collect::<Vec<_>>();
        let more = if lonely.len() > shown.len() {
            format!(" and {} more", lonely.len() - shown.len())
        } else {
            String::new()
        };
        return Err(Failure::with_hint(
            format!("ids without a partner: {}{more}", shown.join(", ")),
            "--drop-unmatched leaves them out",
        ));
    }
    Ok((pairs, lonely))
}
