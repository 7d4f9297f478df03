#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    poseshift_fuzz::readers::profile(bytes);
});
