//! Links the extension module: functions of the same code are one in it.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    // the linker of this target is lld (Rust 1.90)
    if std::env::var("TARGET").as_deref() == Ok("x86_64-unknown-linux-gnu") {
        println!("cargo:rustc-cdylib-link-arg=-Wl,--icf=all");
    }
}
