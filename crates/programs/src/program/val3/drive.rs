//! A program through configurations.

use crate::program::drive::{Step, add};

/// See [`crate::program::Language::drive`]: a program of a project, which needs no data of it.
pub(super) fn drive(steps: &[Step]) -> String {
    let mut out = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n\
        <Programs xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
        xmlns=\"http://www.staubli.com/robotics/VAL3/Program/2\">\n\
        <Program name=\"measure\" access=\"public\"><Locals>\n\
        <Local name=\"l_mFast\" type=\"mdesc\" xsi:type=\"array\" size=\"1\"/>\n\
        <Local name=\"l_mSlow\" type=\"mdesc\" xsi:type=\"array\" size=\"1\"/>\n\
        </Locals><Code><![CDATA[begin\n\
        l_mFast.vel=20\nl_mFast.blend=off\nl_mSlow.vel=5\nl_mSlow.blend=off\n"
        .to_owned();
    add(
        &mut out,
        steps,
        "// ",
        "waitEndMove()\ndelay(3)\n",
        |axes, measured| {
            let speed = if measured { "l_mSlow" } else { "l_mFast" };
            format!("movej({{{}}},flange,{speed})\n", axes.join(","))
        },
    );
    out + "end]]></Code></Program></Programs>\n"
}
