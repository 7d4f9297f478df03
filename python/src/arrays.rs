//! Arrays in and out: shapes, finiteness, rotations that are some.

use numpy::{
    AllowTypeChange, IntoPyArray, PyArray1, PyArrayDyn, PyArrayLikeDyn, PyArrayMethods,
    PyUntypedArrayMethods,
};
use poseshift::geometry::{Pose, Rotation};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::borrow::Cow;

/// Whatever `numpy.asarray` takes, as float64.
pub(crate) type Numbers<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;
/// An array that is given back.
pub(crate) type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

/// How far a rotation's axes may be from unit length and right angles: as files of poses have it.
const UNIT: f64 = 1e-3;
/// Rotations nearer to one than this are taken as they are.
const EXACT: f64 = 1e-12;

/// Rows of N numbers.
pub(crate) struct Rows<'a, const N: usize> {
    numbers: Cow<'a, [f64]>,
    /// Whether it is one row without the leading dimension.
    pub(crate) single: bool,
}

impl<const N: usize> Rows<'_, N> {
    pub(crate) fn rows(&self) -> &[[f64; N]] {
        self.numbers.as_chunks().0
    }
}

/// The numbers in C order.
fn numbers<'a>(array: &'a Numbers<'_>) -> Cow<'a, [f64]> {
    match array.as_slice() {
        Ok(slice) if array.is_c_contiguous() => Cow::Borrowed(slice),
        _ => Cow::Owned(array.as_array().iter().copied().collect()),
    }
}

fn wrong_shape(name: &str, shape: &[usize], wanted: &str) -> PyErr {
    PyValueError::new_err(format!("{name} has shape {shape:?}; it must be {wanted}"))
}

/// That every number is one.
fn finite(name: &str, numbers: &[f64], shape: &[usize]) -> PyResult<()> {
    let Some(at) = numbers.iter().position(|x| !x.is_finite()) else {
        return Ok(());
    };
    let mut rest = at;
    let mut place: Vec<String> = Vec::new();
    for size in shape.iter().rev() {
        place.push((rest % size).to_string());
        rest /= size;
    }
    place.reverse();
    let (place, value) = (place.join(", "), numbers[at]);
    let value = value.to_string().to_lowercase();
    Err(PyValueError::new_err(format!("{name}[{place}] is {value}")))
}

/// Rows of N numbers, (n, N) or (N,).
pub(crate) fn rows<'a, const N: usize>(
    name: &str,
    array: &'a Numbers<'_>,
) -> PyResult<Rows<'a, N>> {
    let shape = array.shape();
    let single = match shape {
        [n] if *n == N => true,
        [_, n] if *n == N => false,
        _ => return Err(wrong_shape(name, shape, &format!("(n, {N}) or ({N},)"))),
    };
    let numbers = numbers(array);
    finite(name, &numbers, shape)?;
    Ok(Rows { numbers, single })
}

/// Numbers, (n,).
pub(crate) fn column<'a>(name: &str, array: &'a Numbers<'_>) -> PyResult<Cow<'a, [f64]>> {
    let shape = array.shape();
    if shape.len() != 1 {
        return Err(wrong_shape(name, shape, "(n,)"));
    }
    let numbers = numbers(array);
    finite(name, &numbers, shape)?;
    Ok(numbers)
}

/// One triple or six numbers of an option.
pub(crate) fn fixed<const N: usize>(name: &str, array: &Numbers<'_>) -> PyResult<[f64; N]> {
    let found = rows::<N>(name, array)?;
    match found.rows() {
        [one] if found.single => Ok(*one),
        _ => Err(wrong_shape(name, array.shape(), &format!("({N},)"))),
    }
}

/// Directions in which joints last moved are -1, 0 or 1; speeds or increments are none.
pub(crate) fn judge_directions(rows: &[[f64; 6]]) -> PyResult<()> {
    let is_none = |value: &&f64| ![-1.0, 0.0, 1.0].contains(*value);
    match rows.iter().flatten().find(is_none) {
        Some(value) => Err(PyValueError::new_err(format!(
            "direction {value} is none of -1, 0 and 1: numpy.sign makes it one"
        ))),
        None => Ok(()),
    }
}

/// Poses, (n, 4, 4) or (4, 4), and whether it is one.
pub(crate) fn poses(name: &str, array: &Numbers<'_>) -> PyResult<(Vec<Pose>, bool)> {
    let shape = array.shape();
    let single = match shape {
        [4, 4] => true,
        [_, 4, 4] => false,
        _ => return Err(wrong_shape(name, shape, "(n, 4, 4) or (4, 4)")),
    };
    let numbers = numbers(array);
    finite(name, &numbers, shape)?;
    let all = numbers.as_chunks::<16>().0.iter().enumerate();
    let poses = all.map(|(i, m)| {
        let at = || {
            if single {
                name.to_owned()
            } else {
                format!("{name}[{i}]")
            }
        };
        pose(m).map_err(|why| PyValueError::new_err(format!("{}: {why}", at())))
    });
    Ok((poses.collect::<PyResult<_>>()?, single))
}

/// One pose, (4, 4).
pub(crate) fn one_pose(name: &str, array: &Numbers<'_>) -> PyResult<Pose> {
    match poses(name, array)? {
        (all, true) => Ok(all[0]),
        _ => Err(wrong_shape(name, array.shape(), "(4, 4)")),
    }
}

fn pose(m: &[f64; 16]) -> Result<Pose, String> {
    if m[12..] != [0.0, 0.0, 0.0, 1.0] {
        let last = &m[12..];
        return Err(format!("the last row is {last:?}; it must be [0, 0, 0, 1]"));
    }
    let rotation = Rotation(std::array::from_fn(|i| {
        std::array::from_fn(|j| m[4 * i + j])
    }));
    let square = rotation.transpose() * rotation;
    let off = |i: usize, j: usize| (square.0[i][j] - if i == j { 1.0 } else { 0.0 }).abs();
    let worst = (0..9).map(|k| off(k / 3, k % 3)).fold(0.0, f64::max);
    let [a, b, c] = rotation.0;
    let handed = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    if worst > UNIT || handed < 0.0 {
        return Err(format!(
            "the upper left is no rotation: its axes are {worst:.1e} off unit length and right angles, the limit is {UNIT:e}; its \
             determinant is {handed:.3}"
        ));
    }
    let rotation = if worst > EXACT {
        rotation.quaternion().normalized().rotation()
    } else {
        rotation
    };
    Ok(Pose {
        rotation,
        translation: [m[3], m[7], m[11]],
    })
}

/// A pose as the sixteen numbers of its matrix.
pub(crate) fn matrix(pose: &Pose) -> [f64; 16] {
    let (r, t) = (&pose.rotation.0, pose.translation);
    [
        r[0][0], r[0][1], r[0][2], t[0], r[1][0], r[1][1], r[1][2], t[1], r[2][0], r[2][1],
        r[2][2], t[2], 0.0, 0.0, 0.0, 1.0,
    ]
}

/// An array of this shape; of a single one without the leading dimension.
pub(crate) fn array<'py>(
    py: Python<'py>,
    numbers: Vec<f64>,
    shape: &[usize],
    single: bool,
) -> PyResult<Array<'py>> {
    let flat = PyArray1::from_vec(py, numbers);
    flat.reshape(&shape[usize::from(single)..])
}

/// Poses as an array.
pub(crate) fn pose_array<'py>(
    py: Python<'py>,
    poses: &[Pose],
    single: bool,
) -> PyResult<Array<'py>> {
    let numbers: Vec<f64> = poses.iter().flat_map(matrix).collect();
    array(py, numbers, &[poses.len(), 4, 4], single)
}

/// Whole numbers as an array.
pub(crate) fn whole<T: numpy::Element>(
    py: Python<'_>,
    numbers: Vec<T>,
    single: bool,
) -> PyResult<Bound<'_, PyAny>> {
    let flat = numbers.into_pyarray(py);
    if single {
        return Ok(flat.reshape([0_usize; 0])?.into_any());
    }
    Ok(flat.into_any())
}
