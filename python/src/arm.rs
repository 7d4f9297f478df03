//! Arms: forward and inverse kinematics of arrays.

use crate::arrays::{Array, Numbers, array, matrix, one_pose, poses, rows, whole};
use crate::errors::Kind;
use crate::threads::{FEW, on_rows};
use numpy::PyUntypedArrayMethods;
use poseshift::inverse::{Branch, Inverse, Outcome, Status, Targets, solve_batch};
use poseshift::model::profile::{Mounted, Profile};
use poseshift::model::{Conditions, Model, forward_batch};
use poseshift::task::Failure;
use poseshift::task::fk::Which;
use poseshift::task::ik::{inverse, middle};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

/// An arm with a tool under conditions that stay.
#[pyclass(frozen, module = "poseshift")]
pub(crate) struct Arm {
    model: Model,
    conditions: Conditions,
    inverse: Result<Inverse, Failure>,
    /// Joints that answers are near to where none are given.
    middle: [f64; 6],
}

impl Arm {
    pub(crate) fn new(
        profile: &Profile,
        tool: &Mounted,
        which: Which,
        conditions: Conditions,
    ) -> Self {
        Self {
            model: match which {
                Which::Real => profile.real_model(tool, &conditions),
                Which::Controller => profile.controller_model(tool),
            },
            conditions,
            inverse: inverse(profile, tool, which, conditions),
            middle: middle(profile),
        }
    }

    fn inverse(&self, py: Python<'_>) -> PyResult<&Inverse> {
        let inverse = self.inverse.as_ref();
        inverse.map_err(|failure| Kind::Arm.raise(py, failure))
    }
}

/// Joint angles for poses.
#[pyclass(frozen, get_all, module = "poseshift")]
pub(crate) struct Solutions {
    /// (n, 6): the controller's joint angles.
    q_rad: Py<PyAny>,
    /// (n,) of uint8: how each search ended, a `Status`.
    status: Py<PyAny>,
    /// (n,) of int8: the joint beyond its limits, from 0; else -1.
    joint: Py<PyAny>,
    /// (n,) of bool: whether the tool reaches the pose.
    converged: Py<PyAny>,
    /// (n,) of uint8: the branch asked for.
    branch: Py<PyAny>,
    /// (n,): distance still missing.
    residual_m: Py<PyAny>,
    /// (n,): angle still missing.
    residual_rad: Py<PyAny>,
    /// (n,) of uint32: evaluations of the model.
    iterations: Py<PyAny>,
}

/// Postures of joint angles.
#[pyclass(frozen, get_all, module = "poseshift")]
pub(crate) struct Postures {
    /// (n,) of uint8.
    branch: Py<PyAny>,
    /// (n,): joint 5 from where axes 4 and 6 align.
    wrist_rad: Py<PyAny>,
    /// (n,): the elbow from stretched or folded.
    elbow_rad: Py<PyAny>,
    /// (n,): the wrist centre from axis 1's singularity.
    shoulder_m: Py<PyAny>,
}

/// A status as a number of `Status`, and the joint that it names.
fn status(status: Status) -> (u8, i8) {
    match status {
        Status::Converged => (0, -1),
        Status::OutOfReach => (1, -1),
        // six joints
        Status::JointLimit(joint) => (2, i8::try_from(joint).unwrap_or(-1)),
        Status::BranchLost => (3, -1),
        Status::NotConverged => (4, -1),
    }
}

fn solutions(
    py: Python<'_>,
    outcomes: &[Outcome],
    branches: &[Branch],
    single: bool,
) -> PyResult<Solutions> {
    let n = outcomes.len();
    let each = |of: fn(&Outcome) -> f64| -> PyResult<Py<PyAny>> {
        let numbers = outcomes.iter().map(of).collect();
        Ok(array(py, numbers, &[n], single)?.into_any().unbind())
    };
    let q = outcomes.iter().flat_map(|o| o.q).collect();
    let ended: Vec<(u8, i8)> = outcomes.iter().map(|o| status(o.status)).collect();
    let branch = branches.iter().map(|branch| branch.number()).collect();
    Ok(Solutions {
        q_rad: array(py, q, &[n, 6], single)?.into_any().unbind(),
        status: whole(py, ended.iter().map(|(s, _)| *s).collect(), single)?.unbind(),
        joint: whole(py, ended.iter().map(|(_, j)| *j).collect(), single)?.unbind(),
        converged: whole(py, ended.iter().map(|(s, _)| *s == 0).collect(), single)?.unbind(),
        branch: whole::<u8>(py, branch, single)?.unbind(),
        residual_m: each(|o| o.residual.distance_m)?,
        residual_rad: each(|o| o.residual.angle_rad)?,
        iterations: whole(py, outcomes.iter().map(|o| o.iterations).collect(), single)?.unbind(),
    })
}

fn branch(number: f64) -> PyResult<Branch> {
    let is_it = |of: &Branch| f64::from(of.number()) == number;
    let found = Branch::ALL.into_iter().find(is_it);
    found.ok_or_else(|| {
        PyValueError::new_err(format!("branch {number} is not a whole number from 0 to 7"))
    })
}

#[pymethods]
impl Arm {
    /// `world_from_tool` (n, 4, 4) of joint angles (n, 6).
    fn forward<'py>(&self, py: Python<'py>, q_rad: Numbers<'py>) -> PyResult<Array<'py>> {
        let found = rows::<6>("q_rad", &q_rad)?;
        let (q, single) = (found.rows(), found.single);
        let (model, conditions) = (&self.model, &self.conditions);
        let numbers = on_rows(py, q.len(), || {
            if let [one] = q {
                return matrix(&model.forward(one, conditions)).to_vec();
            }
            let mut numbers = vec![0.0; 16 * q.len()];
            let chunks = numbers.par_chunks_mut(16 * FEW).zip(q.par_chunks(FEW));
            let fill = |(numbers, q): (&mut [f64], &[[f64; 6]])| {
                let poses = forward_batch(model, conditions, q);
                for (place, pose) in numbers.as_chunks_mut().0.iter_mut().zip(&poses) {
                    *place = matrix(pose);
                }
            };
            if q.len() <= FEW {
                fill((&mut numbers, q));
            } else {
                chunks.for_each(fill);
            }
            numbers
        })?;
        array(py, numbers, &[q.len(), 4, 4], single)
    }

    /// Joint angles for poses, on a branch, near to some.
    #[pyo3(signature = (world_from_tool, *, branch=None, near_rad=None))]
    fn solve(
        &self,
        py: Python<'_>,
        world_from_tool: Numbers<'_>,
        branch: Option<Numbers<'_>>,
        near_rad: Option<Numbers<'_>>,
    ) -> PyResult<Solutions> {
        let inverse = self.inverse(py)?;
        let (wanted, single) = poses("world_from_tool", &world_from_tool)?;
        let n = wanted.len();
        let each = |count: usize, what: &str| {
            if count == n || count == 1 {
                return Ok(());
            }
            Err(PyValueError::new_err(format!(
                "{count} {what} for {n} poses"
            )))
        };
        let near = match &near_rad {
            None => vec![self.middle; n],
            Some(given) => {
                let rows = rows::<6>("near_rad", given)?;
                each(rows.rows().len(), "rows of near_rad")?;
                let mut near = rows.rows().to_vec();
                if near.len() == 1 {
                    near.resize(n, near[0]);
                }
                near
            }
        };
        let branches = match &branch {
            None => near.iter().map(|q| inverse.arm.posture(q).0).collect(),
            Some(given) if given.ndim() <= 1 => {
                let numbers: Vec<f64> = given.as_array().iter().copied().collect();
                each(numbers.len(), "branches")?;
                let found = numbers.into_iter().map(self::branch);
                let mut found = found.collect::<PyResult<Vec<Branch>>>()?;
                if found.len() == 1 {
                    found.resize(n, found[0]);
                }
                found
            }
            Some(_) => {
                return Err(PyValueError::new_err("branch must be a number or (n,)"));
            }
        };
        let outcomes = on_rows(py, n, || {
            let solve = |(wanted, (branches, near))| {
                let targets = Targets {
                    wanted,
                    branches,
                    near,
                };
                solve_batch(inverse, targets)
            };
            if let ([wanted], [branch], [near]) = (&*wanted, &*branches, &*near) {
                return vec![inverse.solve(wanted, *branch, near)];
            }
            if n <= FEW {
                return solve((&wanted, (&branches, &near)));
            }
            let seeds = branches.par_chunks(FEW).zip(near.par_chunks(FEW));
            let chunks = wanted.par_chunks(FEW).zip(seeds);
            chunks
                .flat_map_iter(|(wanted, (b, q))| solve((wanted, (b, q))))
                .collect()
        })?;
        solutions(py, &outcomes, &branches, single)
    }

    /// Joint angles for one pose on every branch.
    fn solve_all(&self, py: Python<'_>, world_from_tool: Numbers<'_>) -> PyResult<Solutions> {
        let inverse = self.inverse(py)?;
        let wanted = one_pose("world_from_tool", &world_from_tool)?;
        let found: Vec<(Branch, Outcome)> = py.detach(|| {
            if inverse.arm.has_offset_wrist() {
                let answers = inverse.arm.solve_all(&wanted, &self.middle).into_iter();
                let sought = |of: poseshift::inverse::Answer| {
                    (of.branch, inverse.solve(&wanted, of.branch, &of.q))
                };
                return answers.map(sought).collect();
            }
            let all = Branch::ALL.into_iter();
            all.map(|branch| (branch, inverse.solve(&wanted, branch, &self.middle)))
                .collect()
        });
        let (branches, outcomes): (Vec<_>, Vec<_>) = found.into_iter().unzip();
        solutions(py, &outcomes, &branches, false)
    }

    /// Branch and distances from singularities of joint angles (n, 6).
    fn posture(&self, py: Python<'_>, q_rad: Numbers<'_>) -> PyResult<Postures> {
        let inverse = self.inverse(py)?;
        let found = rows::<6>("q_rad", &q_rad)?;
        let (n, single) = (found.rows().len(), found.single);
        let q = found.rows();
        let found: Vec<_> = py.detach(|| q.iter().map(|q| inverse.arm.posture(q)).collect());
        let column = |numbers: Vec<f64>| -> PyResult<Py<PyAny>> {
            Ok(array(py, numbers, &[n], single)?.into_any().unbind())
        };
        let branch: Vec<u8> = found.iter().map(|(b, _)| b.number()).collect();
        Ok(Postures {
            branch: whole(py, branch, single)?.unbind(),
            wrist_rad: column(found.iter().map(|(_, m)| m.wrist_rad).collect())?,
            elbow_rad: column(found.iter().map(|(_, m)| m.elbow_rad).collect())?,
            shoulder_m: column(found.iter().map(|(_, m)| m.shoulder_m).collect())?,
        })
    }
}
