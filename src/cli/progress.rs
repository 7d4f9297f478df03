//! A progress bar on standard error, where a person looks and the work takes longer than a second.

use super::Output;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Work shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);
/// How often the line is drawn again.
const TICK: Duration = Duration::from_millis(100);

/// What is drawn until it is dropped.
pub(super) struct Progress {
    bar: ProgressBar,
    /// Closed when the work is done; nothing is drawn without.
    done: Option<(Sender<()>, JoinHandle<()>)>,
}

fn styled(bar: &ProgressBar, template: &str) {
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
}

impl Progress {
    /// Shows `what` is going on, from a second on, unless output is quiet or nobody sees it.
    pub(super) fn new(output: Output, what: &'static str) -> Self {
        Self::on_terminal(
            !output.quiet && std::io::stderr().is_terminal(),
            ProgressDrawTarget::stderr,
            what,
        )
    }

    fn on_terminal(shown: bool, target: fn() -> ProgressDrawTarget, what: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        styled(&bar, "{spinner} {msg} {elapsed}");
        bar.set_message(what);
        let done = shown.then(|| {
            let (send, receive) = channel();
            let drawn = bar.clone();
            let watch = std::thread::spawn(move || {
                if receive.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                    drawn.set_draw_target(target());
                    drawn.enable_steady_tick(TICK);
                    // until the work is done
                    let _ = receive.recv();
                    drawn.finish_and_clear();
                }
            });
            (send, watch)
        });
        Self { bar, done }
    }

    /// What is going on now.
    pub(super) fn say(&self, what: &str) {
        self.bar.set_message(what.to_owned());
    }

    /// How much of the work is done.
    pub(super) fn tell(&self, done: usize, of: usize) {
        if self.bar.length().is_none() {
            styled(&self.bar, "{msg} [{bar:30}] {pos}/{len} {elapsed}");
            self.bar.set_length(of as u64);
        }
        self.bar.set_position(done as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((send, watch)) = self.done.take() {
            drop(send);
            // a bar that could not be drawn changes no result
            let _ = watch.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use indicatif::InMemoryTerm;
    use std::sync::OnceLock;

    fn screen() -> &'static InMemoryTerm {
        static SCREEN: OnceLock<InMemoryTerm> = OnceLock::new();
        SCREEN.get_or_init(|| InMemoryTerm::new(5, 80))
    }

    fn target() -> ProgressDrawTarget {
        ProgressDrawTarget::term_like(Box::new(screen().clone()))
    }

    #[test]
    fn only_long_work_that_somebody_sees_is_shown() {
        for (shown, wait_ms, drawn) in
            [(true, 100, false), (false, 1400, false), (true, 1400, true)]
        {
            let progress = Progress::on_terminal(shown, target, "choosing");
            progress.tell(3, 10);
            std::thread::sleep(Duration::from_millis(wait_ms));
            let seen = screen().contents();
            assert_eq!(
                seen.contains("choosing [") && seen.contains("3/10"),
                drawn,
                "{seen}"
            );
            drop(progress);
            assert_eq!(screen().contents(), "");
        }
    }
}
