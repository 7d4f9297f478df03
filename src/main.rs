//! The command line of poseshift.

fn main() -> std::process::ExitCode {
    give_large_blocks_back();
    #[cfg(target_os = "linux")]
    closed_output::keep_closed();
    poseshift::run_with(std::env::args_os()).into()
}

/// Lets blocks from 1 MB on go back to the system as soon as they are free.
///
/// Once such a block was freed, glibc takes others of its size from the heap, where a small block
/// behind it keeps it: a column of 100 000 rows, a list of 100 000 targets.
///
/// # Source
/// mallopt(3), `M_MMAP_THRESHOLD`: a threshold that is set stays as it is.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[allow(unsafe_code, reason = "a setting of the C library's allocator")]
fn give_large_blocks_back() {
    const FROM_BYTES: libc::c_int = 1 << 20;
    // SAFETY: it takes two numbers and changes a setting; no other thread runs yet
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, FROM_BYTES);
    }
}

#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
const fn give_large_blocks_back() {}

/// A standard output that is closed when the program starts (`>&-`).
///
/// The standard library puts `/dev/null` in its place before `main`, and what is printed there would
/// count as printed.
#[cfg(target_os = "linux")]
#[allow(
    unsafe_code,
    reason = "what the standard library does before main is seen only before it"
)]
mod closed_output {
    use std::os::fd::AsRawFd;
    use std::sync::atomic::{AtomicBool, Ordering};

    static IS_CLOSED: AtomicBool = AtomicBool::new(false);

    // SAFETY: the loader calls the functions of this section once, before `main`
    #[used]
    #[unsafe(link_section = ".init_array")]
    static BEFORE_MAIN: extern "C" fn() = look;

    extern "C" fn look() {
        // SAFETY: it asks for the flags of a descriptor
        let flags = unsafe { libc::fcntl(libc::STDOUT_FILENO, libc::F_GETFD) };
        IS_CLOSED.store(flags == -1, Ordering::Relaxed);
    }

    /// Puts a pipe that nobody reads in the place of `/dev/null`: what is printed then fails.
    pub fn keep_closed() {
        if !IS_CLOSED.load(Ordering::Relaxed) {
            return;
        }
        if let Ok((reader, writer)) = std::io::pipe() {
            drop(reader);
            // SAFETY: both descriptors are open, and nothing was printed yet
            unsafe {
                libc::dup2(writer.as_raw_fd(), libc::STDOUT_FILENO);
            }
        }
    }
}
