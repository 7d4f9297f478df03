//! The command line of poseshift.

fn main() -> std::process::ExitCode {
    give_large_blocks_back();
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
