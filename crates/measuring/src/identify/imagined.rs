//! What would be measured at configurations: derivatives before there are measurements.

use super::error::IdentifyError;
use super::expectation::{four_slopes, slopes};
use super::holder::Holder;
use super::line::Line;
use super::measurements::{DIRECTION_COLUMNS, Measurement, Measurements, Observed};
use super::normal::Normal;
use super::observation::Observation;
use super::parameters::{Parameter, Selection, Subject};
use super::problem::{Estimate, Problem, Row};
use crate::geometry::{Four, Pose, Vector, WIDTH, constant};
use crate::model::batch::side_by_side;
use crate::model::external::Stand;
use crate::model::{Conditions, FourMotions, Motion};
use crate::profile::{Mounted, Profile};
use nalgebra::{DMatrix, DMatrixView, DVector};
use pulp::Arch;
use rayon::prelude::*;
use std::ops::Range;

/// Numbers of a pose.
const POSE_NUMBERS: usize = 6;
/// A part of a configuration's information below which there is none.
const NOTHING: f64 = 1e-12;
/// Configurations that one thread takes at a time.
const PORTION: usize = 32 * WIDTH;

/// A problem whose rows are these configurations, with external axes where each of them has them,
/// to take derivatives of.
pub(super) fn imagined(
    profile: &Profile,
    tool: &Mounted,
    selection: &Selection,
    (joints, stands): (&[[f64; 6]], &[&Stand]),
    poses: bool,
) -> Result<(Problem, Estimate), IdentifyError> {
    let row = |q: &[f64; 6], stand: &Stand, point: Option<&String>| Measurement {
        line: Line::default(),
        id: String::new(),
        q: *q,
        observed: if poses {
            Observed::Pose(Pose::identity())
        } else {
            Observed::Position([0.0; 3])
        },
        tool: profile
            .tools
            .contains_key(&tool.name)
            .then(|| tool.name.clone()),
        point: point.cloned(),
        point_in_tool_m: None,
        conditions: Conditions::default(),
        stand: stand.clone(),
        plate: None,
        sigma_m: None,
        sigma_rad: None,
        purpose: None,
        contact: None,
    };
    let mut rows = Vec::new();
    for (q, stand) in joints.iter().zip(stands) {
        if profile.points.is_empty() {
            rows.push(row(q, stand, None));
        }
        rows.extend(profile.points.keys().map(|name| row(q, stand, Some(name))));
    }
    let measurements = Measurements {
        rows,
        columns: DIRECTION_COLUMNS.map(str::to_owned).to_vec(),
    };
    Problem::new(profile, &measurements, selection, profile.world_from_base)
}

/// Derivatives of what is measured at each configuration by the parameters, in their scales and in
/// standard deviations: `[configuration][row][parameter]`.
#[derive(Clone, Debug)]
pub(super) struct Derivatives {
    /// Rows of a configuration.
    pub height: usize,
    /// Parameters.
    pub width: usize,
    cells: Vec<f64>,
}

/// Derivatives of some configurations, four side by side where links do not bend.
struct Pass<'a> {
    problem: &'a Problem,
    estimate: &'a Estimate,
    models: &'a [Holder],
    rows: &'a [Row],
    sigma_m: f64,
    joints: &'a [[f64; 6]],
    cells: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Pass<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let parameters = &self.problem.parameters;
        let (models, width) = (self.models, parameters.len());
        let four: Vec<_> = models.iter().map(Holder::four).collect();
        let effects = parameters
            .iter()
            .filter(|p| matches!(p.subject, Subject::Effect(_)))
            .count();
        let mut motions = vec![Motion::default(); effects];
        let mut four_motions = vec![FourMotions::none(); effects];
        // where each row's numbers start
        let mut tops = Vec::with_capacity(self.rows.len());
        let mut height = 0;
        for row in self.rows {
            tops.push(height);
            height += row.observed.count();
        }
        let cells = self.cells.chunks_mut(height * width * WIDTH);
        for (joints, cells) in self.joints.chunks(WIDTH).zip(cells) {
            for (row, top) in self.rows.iter().zip(&tops) {
                let by = Observation::new(row, Pose::identity(), [0.0; 3]).weights();
                let by = by.map(|weight| weight * row.sigma_m / self.sigma_m);
                let count = row.observed.count();
                let mut put = |lane: usize, column: usize, slope: [f64; POSE_NUMBERS]| {
                    for k in 0..count {
                        cells[(lane * height + top + k) * width + column] = slope[k] * by[k];
                    }
                };
                let point = self.problem.point_in_tool_m(self.estimate, row);
                if let Some(four) = &four[row.rig] {
                    // a last one stands for those that are not there
                    let at = |i: usize| &joints[i.min(joints.len() - 1)];
                    let q = side_by_side([at(0), at(1), at(2), at(3)]);
                    let pose = four.evaluate(&q, &row.conditions, &mut four_motions);
                    let arm = pose.rotation * constant(point);
                    let points = [row.point; WIDTH];
                    let each = |column: usize, shift: Vector<Four>, turn: Vector<Four>| {
                        for lane in 0..joints.len() {
                            let [x, y, z] = shift.map(|c| c.0[lane]);
                            let [a, b, c] = turn.map(|c| c.0[lane]);
                            put(lane, column, [x, y, z, a, b, c]);
                        }
                    };
                    four_slopes(&pose, arm, &four_motions, parameters, points, each);
                } else {
                    for (lane, q) in joints.iter().enumerate() {
                        let pose = models[row.rig].evaluate(q, &row.conditions, &mut motions);
                        let seen = self.problem.observe(self.estimate, row, pose);
                        slopes(&seen, &motions, parameters, |column, slope| {
                            put(lane, column, slope);
                        });
                    }
                }
            }
        }
    }
}

impl Derivatives {
    /// Of configurations with external axes at some places, `at` of each: a place's are measured as
    /// some rows of a problem are.
    pub(super) fn of_places(
        problem: &Problem,
        estimate: &Estimate,
        (joints, at): (&[[f64; 6]], &[usize]),
        rows_of: &[Range<usize>],
        sigma_m: f64,
    ) -> Self {
        if let [rows] = rows_of {
            return Self::of_joints(problem, estimate, joints, rows.clone(), sigma_m);
        }
        let mut all = Self {
            height: 0,
            width: problem.parameters.len(),
            cells: Vec::new(),
        };
        for (place, rows) in rows_of.iter().enumerate() {
            let own: Vec<usize> = (0..joints.len()).filter(|i| at[*i] == place).collect();
            let there: Vec<[f64; 6]> = own.iter().map(|i| joints[*i]).collect();
            let found = Self::of_joints(problem, estimate, &there, rows.clone(), sigma_m);
            all.height = found.height;
            let size = all.height * all.width;
            all.cells.resize(joints.len() * size, 0.0);
            for (cells, i) in found.cells.chunks_exact(size).zip(own) {
                all.cells[i * size..][..size].copy_from_slice(cells);
            }
        }
        all
    }

    /// Of configurations that are measured as these rows of a problem are, by its parameters;
    /// `sigma_m` is the standard deviation of a coordinate.
    pub(super) fn of_joints(
        problem: &Problem,
        estimate: &Estimate,
        joints: &[[f64; 6]],
        rows: Range<usize>,
        sigma_m: f64,
    ) -> Self {
        let rows = &problem.rows[rows];
        let height: usize = rows.iter().map(|row| row.observed.count()).sum();
        let width = problem.parameters.len();
        let models = problem.models(estimate, &problem.parameters);
        let mut cells = vec![0.0; joints.len() * height * width];
        cells
            .par_chunks_mut(PORTION * height * width)
            .zip(joints.par_chunks(PORTION))
            .for_each(|(cells, joints)| {
                Arch::new().dispatch(Pass {
                    problem,
                    estimate,
                    models: &models,
                    rows,
                    sigma_m,
                    joints,
                    cells,
                });
            });
        Self {
            height,
            width,
            cells,
        }
    }

    /// Of the rows of a problem as they stand, so many of each configuration.
    pub(super) fn of_rows(
        problem: &Problem,
        estimate: &Estimate,
        each: usize,
        sigma_m: f64,
    ) -> Self {
        let parameters = &problem.parameters;
        let models = problem.models(estimate, parameters);
        let width = parameters.len();
        let is_effect = |p: &&Parameter| matches!(p.subject, Subject::Effect(_));
        let mut motions = vec![Motion::default(); parameters.iter().filter(is_effect).count()];
        let (mut cells, mut height) = (Vec::new(), 0);
        for row in problem.rows.iter() {
            let pose = models[row.rig].evaluate(&row.q, &row.conditions, &mut motions);
            let seen = problem.observe(estimate, row, pose);
            let by = seen.weights().map(|weight| weight * row.sigma_m / sigma_m);
            let (top, count) = (cells.len(), row.observed.count());
            cells.resize(top + count * width, 0.0);
            slopes(&seen, &motions, parameters, |column, slope| {
                for k in 0..count {
                    cells[top + k * width + column] = slope[k] * by[k];
                }
            });
            height = each * count;
        }
        Self {
            height,
            width,
            cells,
        }
    }

    /// How many configurations.
    pub(super) fn count(&self) -> usize {
        self.cells.len() / (self.height * self.width).max(1)
    }

    /// Those of one configuration, row by row.
    pub(super) fn of(&self, configuration: usize) -> &[f64] {
        let size = self.height * self.width;
        &self.cells[configuration * size..][..size]
    }

    /// `Jᵀ` of one configuration.
    pub(super) fn columns(&self, configuration: usize) -> DMatrixView<'_, f64> {
        DMatrixView::from_slice(self.of(configuration), self.width, self.height)
    }

    /// Adds `JᵀJ` of one configuration.
    pub(super) fn add_information(&self, configuration: usize, to: &mut DMatrix<f64>) {
        for row in self.columns(configuration).column_iter() {
            to.ger(1.0, &row, &row, 1.0);
        }
    }

    /// Normal equations of every so manieth configuration without measurements, in standard
    /// deviations of so many of these.
    pub(super) fn normal(&self, every: usize, sigmas: f64, parameters: &[Parameter]) -> Normal {
        let cells: Vec<f64> = (0..self.count())
            .step_by(every)
            .flat_map(|i| self.of(i))
            .map(|slope| slope / sigmas)
            .collect();
        let columns = DMatrixView::from_slice(&cells, self.width, cells.len() / self.width.max(1));
        let mut matrix = columns * columns.transpose();
        for (i, parameter) in parameters.iter().enumerate() {
            if let Some((_, sigma)) = parameter.prior {
                matrix[(i, i)] += (parameter.scale / sigma).powi(2);
            }
        }
        Normal {
            matrix,
            gradient: DVector::zeros(self.width),
            cost: 0.0,
            squares: Vec::new(),
            prior_squares: vec![0.0; self.width],
        }
    }

    /// By some of the parameters.
    pub(super) fn by(self, kept: &[usize]) -> Self {
        if kept.len() == self.width {
            return self;
        }
        let rows = self.cells.chunks_exact(self.width);
        Self {
            height: self.height,
            width: kept.len(),
            cells: rows.flat_map(|row| kept.iter().map(|i| row[*i])).collect(),
        }
    }

    /// The same information in fewer rows, where every configuration tells as much in
    /// [`POSE_NUMBERS`]: several known points on one tool say no more than its pose.
    pub(super) fn in_fewer_rows(self) -> Self {
        let (height, width) = (self.height, self.width);
        if height <= POSE_NUMBERS {
            return self;
        }
        let fewer = |i: usize| {
            let columns = self.columns(i);
            let eigen = columns.tr_mul(&columns).symmetric_eigen();
            let mut order: Vec<usize> = (0..height).collect();
            order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
            let (most, next) = (
                eigen.eigenvalues[order[0]],
                eigen.eigenvalues[order[POSE_NUMBERS]],
            );
            let directions = eigen.eigenvectors.select_columns(&order[..POSE_NUMBERS]);
            (next <= NOTHING * most).then(|| columns * directions)
        };
        let found: Option<Vec<_>> = (0..self.count()).into_par_iter().map(fewer).collect();
        match found {
            None => self,
            Some(found) => Self {
                height: POSE_NUMBERS,
                width,
                cells: found.iter().flat_map(|m| m.iter().copied()).collect(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::parameters::Level;
    use crate::identify::random::Random;
    use crate::identify::robust::Loss;

    #[test]
    fn several_points_on_one_tool_are_as_much_as_six_numbers() {
        let mut random = Random::new(5);
        let mut matrix =
            |rows, columns| DMatrix::from_fn(rows, columns, |_, _| random.between(-1.0, 1.0));
        let of = |all: &[DMatrix<f64>]| Derivatives {
            height: 9,
            width: 20,
            cells: all
                .iter()
                .flat_map(|j| j.transpose().data.as_vec().clone())
                .collect(),
        };
        let all: Vec<DMatrix<f64>> = (0..4).map(|_| matrix(9, 6) * matrix(6, 20)).collect();
        let fewer = of(&all).in_fewer_rows();
        assert_eq!(fewer.height, 6);
        for (i, j) in all.iter().enumerate() {
            let columns = fewer.columns(i);
            let gap = (j.tr_mul(j) - columns * columns.transpose()).abs().max();
            assert!(gap < 1e-10, "{gap}");
        }
        // where one tells more, all stay as they are
        let mut mixed = all;
        mixed[2] = matrix(9, 20);
        assert_eq!(of(&mixed).in_fewer_rows().height, 9);
    }

    #[test]
    fn derivatives_are_those_that_normal_equations_are_gathered_from() {
        let mut profile =
            Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))
                .expect("a shipped profile");
        let tool = profile.tool("artifact").expect("its tool");
        let mut random = Random::new(6);
        // 13: the last four are not full
        let joints: Vec<[f64; 6]> = (0..13)
            .map(|_| [0.0; 6].map(|_: f64| random.between(-1.5, 1.5)))
            .collect();
        for (points, poses, named) in [(0, false, ""), (0, true, ""), (3, false, "link_compliance")]
        {
            profile.points = (0..points)
                .map(|i| (format!("p{i}"), [0.02 * f64::from(i), 0.01, -0.03]))
                .collect();
            let mut selection = Selection::level(Level::Compliance);
            if !named.is_empty() {
                selection.identify = super::super::pick::Pick::parse_list(named).expect("a word");
            }
            let (problem, estimate) = {
                let none = Stand::default();
                let stands = vec![&none; joints.len()];
                imagined(&profile, &tool, &selection, (&joints, &stands), poses).expect("rows")
            };
            let each = problem.rows.len() / joints.len();
            let found = Derivatives::of_joints(&problem, &estimate, &joints, 0..each, 2e-4);
            assert_eq!(found.count(), joints.len());
            let mine = found.normal(1, 0.5, &problem.parameters).matrix;
            let peer = Normal::of(&problem, &estimate, &problem.parameters, Loss::squares()).matrix;
            for i in 0..found.width {
                for j in 0..found.width {
                    let size = (peer[(i, i)] * peer[(j, j)]).sqrt();
                    let gap = (mine[(i, j)] - peer[(i, j)]).abs();
                    assert!(gap <= 1e-9 * size, "{i} {j}: {gap} of {size}");
                }
            }
        }
    }
}
