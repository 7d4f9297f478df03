//! Threads: a pool of our own, made anew after a fork, and work that Ctrl-C stops.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// How often a long call asks whether somebody wants it to stop.
const TICK: Duration = Duration::from_millis(50);
/// Rows that are worth a second thread.
pub(crate) const FEW: usize = 512;

/// As many as [`set`] says; 0 is not said.
static COUNT: AtomicUsize = AtomicUsize::new(0);
/// The pool and the process whose threads it has.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// Threads that may be asked for: more only wait for each other.
const MOST: usize = 1024;

fn count() -> PyResult<usize> {
    let said = COUNT.load(Ordering::Relaxed);
    if said > 0 {
        return Ok(said);
    }
    let Ok(text) = std::env::var("POSESHIFT_THREADS") else {
        return Ok(0);
    };
    // 0 is one a core
    let count = text.trim().parse().ok().filter(|count| *count <= MOST);
    count.ok_or_else(|| {
        let message = format!("POSESHIFT_THREADS is `{text}`: it is a number of threads up to {MOST}, 0 for one a core");
        PyValueError::new_err(message)
    })
}

pub(crate) fn set(count: Option<usize>) -> PyResult<()> {
    if let Some(count) = count.filter(|count| *count > MOST) {
        let message = format!("{count} threads: at most {MOST} can be had");
        return Err(PyValueError::new_err(message));
    }
    COUNT.store(count.unwrap_or(0), Ordering::Relaxed);
    forget(&mut POOL.lock().unwrap_or_else(PoisonError::into_inner));
    Ok(())
}

/// A pool of another process has no threads here: nobody would answer its end.
fn forget(kept: &mut Option<(u32, Arc<ThreadPool>)>) {
    if let Some((process, pool)) = kept.take()
        && process != std::process::id()
    {
        std::mem::forget(pool);
    }
}

/// The pool of this process.
fn pool() -> PyResult<Arc<ThreadPool>> {
    let mut kept = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((process, pool)) = &*kept
        && *process == std::process::id()
    {
        return Ok(Arc::clone(pool));
    }
    forget(&mut kept);
    let made = ThreadPoolBuilder::new().num_threads(count()?).build();
    let made = Arc::new(made.map_err(|error| {
        pyo3::exceptions::PyRuntimeError::new_err(format!("no threads can be started: {error}"))
    })?);
    *kept = Some((std::process::id(), Arc::clone(&made)));
    Ok(made)
}

/// Work on `rows` rows without the interpreter's lock, in the pool where there are many.
pub(crate) fn on_rows<T: Send>(
    py: Python<'_>,
    rows: usize,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    if rows <= FEW {
        return Ok(py.detach(work));
    }
    let pool = pool()?;
    Ok(py.detach(|| pool.install(work)))
}

/// Whether somebody wants the work to stop.
#[derive(Default)]
pub(crate) struct Stop(AtomicBool);

impl Stop {
    /// Ends the work here if so.
    pub(crate) fn here(&self) {
        if self.0.load(Ordering::Relaxed) {
            // unwinds to `long` without a word
            resume_unwind(Box::new(()));
        }
    }
}

/// The exception of a signal that has come.
fn signals(py: Python<'_>) -> PyResult<()> {
    py.check_signals()
}

/// Long work without the interpreter's lock; a signal ends the call within a tick. The work itself
/// ends at its next [`Stop::here`], on threads that no other call waits for.
pub(crate) fn long<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Stop) -> T + Send + 'static,
) -> PyResult<T> {
    let pool = pool()?;
    let stop = Arc::new(Stop::default());
    let (send, receive) = channel();
    let heard = Arc::clone(&stop);
    std::thread::spawn(move || {
        let found = catch_unwind(AssertUnwindSafe(|| pool.install(|| work(&heard))));
        // nobody waits for what was stopped
        let _ = send.send(found);
    });
    py.detach(move || {
        loop {
            match receive.recv_timeout(TICK) {
                Ok(Ok(found)) => return Ok(found),
                Ok(Err(panic)) => resume_unwind(panic),
                Err(RecvTimeoutError::Disconnected) => {
                    let message = "the thread that computes has ended without an answer";
                    return Err(pyo3::exceptions::PyRuntimeError::new_err(message));
                }
                Err(RecvTimeoutError::Timeout) => Python::attach(signals).inspect_err(|_| {
                    stop.0.store(true, Ordering::Relaxed);
                    *POOL.lock().unwrap_or_else(PoisonError::into_inner) = None;
                })?,
            }
        }
    })
}
