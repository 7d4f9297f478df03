//! Numbers that the text tells in a roundabout form displace a point as the numbers themselves would.

use super::displaced::{misses, of_krl, of_rapid, of_urscript, unknown};
use super::{errors, message};
use poseshift::compensate::Compensation;

/// The program misses what another one misses in which the numbers are written out.
fn same(done: &Compensation, written_out: &Compensation, case: &str) {
    let truth = misses(written_out);
    assert!(truth[0] > 0.05, "{case}: {:?}", written_out.findings);
    let said = [misses(done), unknown(done)].concat();
    assert_eq!(said, truth, "{case}: {:?}", done.findings);
}

/// What is not followed is refused, and its finding says how far from the target all is right.
fn refused(done: &Compensation, case: &str) {
    assert_eq!(
        errors(done),
        ["displacement-unknown"],
        "{case}: {:?}",
        done.findings
    );
    let said = message(done, "displacement-unknown");
    assert!(
        said.contains("not bound") && said.contains("mm from it"),
        "{case}: {said}"
    );
}

/// What only the running robot knows is judged as a sensor's value, in words that say so.
fn sensed(done: &Compensation, case: &str) {
    assert_eq!(unknown(done).len(), 1, "{case}: {:?}", done.findings);
    let said = message(done, "displacement-unknown");
    assert!(said.contains("up to 5 mm"), "{case}: {said}");
}

fn go(by: &str) -> String {
    format!("MoveL Offs(p,{by}),v100,fine,tool0;")
}

#[test]
fn rapid_functions_parameters_and_coordinates_are_worked_out() {
    let truth = of_rapid("", &go("0,0,-200"));
    let at = "[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    let two = format!(
        "CONST robtarget high:=[[0,0,500],{at};\nCONST robtarget low:=[[0,0,300.0],{at};\n"
    );
    let function = "FUNC num depth(num x)\nRETURN -2*x;\nENDFUNC\n";
    let by_reference = "PROC lower(INOUT num z)\nz:=-200;\nENDPROC\n";
    for (data, body) in [
        ("VAR num h:=200;", go("0,0,-Abs(h)")),
        ("VAR num h:=200;", go("0,0,-Abs(-h)")),
        ("VAR num h:=40000;", go("0,0,-Sqrt(h)")),
        ("VAR dnum h:=200;", go("0,0,-DnumToNum(h)")),
        (&*format!("VAR num h:=100;\n{function}"), go("0,0,depth(h)")),
        (&*two, go("0,0,low.trans.z-high.trans.z")),
        ("VAR num a{200};", go("0,0,-Dim(a,1)")),
        ("VAR num a{3,200};", go("0,0,-Dim(a,2)")),
        ("VAR pos o:=[0,0,-200];", go("0,0,o.z")),
        ("PERS pos o:=[5,5,-200];", go("o.x-5,o.y-5,o.z")),
        (
            "VAR pos o:=[0,0,-200];\nVAR pos o2:=[0,0,-200];",
            format!("o:=o2;\n{}", go("o.x,o.y,o.z")),
        ),
        (
            "CONST pos o:=[0,0,-200];",
            "q:=p;\nq.trans:=q.trans+o;\nMoveL q,v100,fine,tool0;".to_owned(),
        ),
        (
            "PROC go(pos o)\nMoveL Offs(p,o.x,o.y,o.z),v100,fine,tool0;\nENDPROC\n",
            "go [0,0,-200];".to_owned(),
        ),
        (
            &*format!("VAR num h;\n{by_reference}"),
            format!("lower h;\n{}", go("0,0,h")),
        ),
    ] {
        same(&of_rapid(data, &body), &truth, &body);
    }
}

#[test]
fn rapid_numbers_that_are_not_followed_are_refused_and_those_of_the_robot_are_not() {
    // coordinates that are written one by one
    let lower = format!("o.z:=-200;\n{}", go("o.x,o.y,o.z"));
    let lower = of_rapid("VAR pos o;", &lower);
    let truth = misses(&of_rapid("", &go("0,0,-200")));
    assert_eq!(unknown(&lower), truth, "{:?}", lower.findings);
    let by_reference = "PROC lower(INOUT num z)\nz:=z-5;\nENDPROC\n";
    let again = format!(
        "WHILE DInput(di1)=1 DO\nlower h;\n{}\nENDWHILE",
        go("0,0,h")
    );
    let grown = of_rapid(&format!("VAR num h;\n{by_reference}"), &again);
    assert_eq!(
        errors(&grown),
        ["displacement-unknown"],
        "{:?}",
        grown.findings
    );
    for (data, body) in [
        ("VAR pos o;", "Incr o.z;"),
        (
            "VAR pos o;\nPROC set(INOUT pos a)\na.z:=-200;\nENDPROC\n",
            "set o;",
        ),
        (
            "VAR pos o;\nPROC set(INOUT num a)\na:=-200;\nENDPROC\n",
            "set o.z;",
        ),
        ("VAR num h;", "SetAllDataVal \"num\",h;"),
    ] {
        let done = of_rapid(data, &format!("{body}\n{}", go("0,0,o.z+h")));
        assert!(!errors(&done).is_empty(), "{body}: {:?}", done.findings);
    }
    for (data, by) in [
        ("VAR num h:=200;", "0,0,-Pow(h,1)"),
        ("VAR pos o:=[0,0,-200];", "0,0,-Distance([0,0,0],o)"),
        (
            "RECORD step\nnum h;\nENDRECORD\nVAR step s:=[-200];",
            "0,0,s.h",
        ),
    ] {
        refused(&of_rapid(data, &go(by)), by);
    }
    // where the robot is may be far from the target
    let now = format!("now:=CRobT(\\Tool:=tool0);\n{}", go("0,0,now.trans.z"));
    refused(&of_rapid("VAR robtarget now;", &now), &now);
    for (data, body) in [
        ("", go("0,0,nCamera")),
        ("", go("0,0,AInput(ai1)")),
        (
            "VAR num h;",
            format!("TPReadNum h,\"mm\";\n{}", go("0,0,h")),
        ),
        ("VAR num h;", format!("measure h;\n{}", go("0,0,h"))),
        ("VAR pos o;", format!("measure o;\n{}", go("0,0,o.z"))),
        (
            "VAR pos o;\nVAR rawbytes rb;",
            format!("UnpackRawBytes rb,1,o.z\\Float4;\n{}", go("0,0,o.z")),
        ),
        (
            "VAR pos o;\nVAR bool ok;",
            format!("ok:=StrToVal(\"5\",o.z);\n{}", go("0,0,o.z")),
        ),
    ] {
        sensed(&of_rapid(data, &body), &body);
    }
}

#[test]
fn krl_arrays_frames_and_functions_are_worked_out() {
    let truth = of_krl("", "LIN XP:{X 0,Y 0,Z 200,A 0,B 0,C 0}\n");
    let lower = of_krl("", "q=XP\nq.Y=q.Y-200\nLIN q\n");
    for (data, body) in [
        (
            "DECL FRAME off\n",
            "off={X 0,Y 0,Z 200,A 0,B 0,C 0}\nLIN XP:off\n",
        ),
        (
            "DECL FRAME off,two\n",
            "two={X 0,Y 0,Z 200,A 0,B 0,C 0}\noff=two\nLIN XP:off\n",
        ),
        (
            "DECL FRAME off\n",
            "sub({X 0,Y 0,Z 200,A 0,B 0,C 0})\nEND\nDEF sub(d:IN)\nDECL FRAME d\nLIN XP:d\n",
        ),
    ] {
        same(&of_krl(data, body), &truth, body);
    }
    // one of two
    let nothing = "off=$NULLFRAME\noff={Z 200}\nLIN XP:off\n";
    let either = of_krl("DECL FRAME off\n", nothing);
    assert_eq!(unknown(&either), misses(&truth), "{:?}", either.findings);
    for (data, body) in [
        ("DECL REAL h[2]\n", "h[1]=200\nq=XP\nq.Y=q.Y-h[1]\nLIN q\n"),
        ("DECL REAL h\n", "h=-200\nq=XP\nq.Y=q.Y-ABS(h)\nLIN q\n"),
        (
            "DECL FRAME off\n",
            "off={X 0,Y 200,Z 0,A 0,B 0,C 0}\nq=XP\nq.Y=q.Y-off.Y\nLIN q\n",
        ),
        (
            "DECL REAL h\n",
            "set(h)\nq=XP\nq.Y=q.Y-h\nLIN q\nEND\nDEF set(d:OUT)\nDECL REAL d\nd=200\n",
        ),
        (
            "DECL REAL h\n",
            "$OUT[set(h)]=TRUE\nq=XP\nq.Y=q.Y-h\nLIN q\nEND\nDEFFCT INT set(d:OUT)\nDECL REAL \
             d\nd=200\nRETURN(1)\nENDFCT\nDEF last()\n",
        ),
        (
            "",
            "q=XP\nq.Y=q.Y-deep(100)\nLIN q\nEND\nDEFFCT REAL deep(d:IN)\nDECL REAL d\nRETURN(2*d)\n\
             ENDFCT\nDEF last()\n",
        ),
    ] {
        same(&of_krl(data, body), &lower, body);
    }
}

#[test]
fn krl_numbers_that_are_not_followed_are_refused_and_those_of_the_robot_are_not() {
    for (data, body) in [
        (
            "DECL FRAME off,a\n",
            "off=a:{X 0,Y 0,Z 200,A 0,B 0,C 0}\nLIN XP:off\n",
        ),
        ("DECL REAL h\n", "h=200\nq=XP\nq.Y=q.Y-ATAN2(h,1)\nLIN q\n"),
    ] {
        refused(&of_krl(data, body), body);
    }
    let zero = "off={X 0,Y 0,Z 0,A 0,B 0,C 0}\n";
    let lower = "q=XP\nq.Y=q.Y-off.Y\nLIN q\n";
    for (data, body) in [
        ("", "q=XP\nq.Y=q.Y-$ANIN[1]\nLIN q\n".to_owned()),
        ("", "q=XP\nq.Y=q.Y-CAM_Y\nLIN q\n".to_owned()),
        // a frame that a routine of another file fills in, or a component of it
        ("DECL FRAME off\n", "CAM(off)\nLIN XP:off\n".to_owned()),
        ("DECL FRAME off\n", format!("{zero}CAM(off)\nLIN XP:off\n")),
        ("DECL FRAME off\n", format!("{zero}CAM(off.Y)\n{lower}")),
        (
            "DECL FRAME off\n",
            format!("{zero}ANIN ON off.Y=1*$ANIN[1]+0\n{lower}"),
        ),
    ] {
        sensed(&of_krl(data, &body), &body);
    }
    // what is declared elsewhere has what is written here, or more
    for body in [
        "OFF={X 0,Y 0,Z 200,A 0,B 0,C 0}\nLIN XP:OFF\n",
        "OFF.Y=200\nq=XP\nq.Y=q.Y-OFF.Y\nLIN q\n",
    ] {
        let done = of_krl("", body);
        assert_eq!(
            errors(&done),
            ["displacement-unknown"],
            "{body}: {:?}",
            done.findings
        );
    }
    // what a declaration leaves out is not taken for the rest
    let all = format!("{zero}LIN XP:off\n");
    refused(
        &of_krl("DECL FRAME off={Z 200}\n", &all),
        "a part of a frame",
    );
    let long = format!(
        "sub(200{})\nEND\nDEF sub(d:IN)\nDECL REAL d\n",
        "+0".repeat(150)
    );
    let long = format!("{long}DECL E6POS r\nr=XP\nr.Y=r.Y-d\nLIN r\n");
    refused(&of_krl("", &long), "a long argument");
}

#[test]
fn urscript_offsets_lists_and_functions_are_worked_out() {
    let go = |by: &str| format!("movel(pose_trans(w,{by}),a=1,v=0.1)\n");
    let truth = of_urscript("", &go("p[0,0,-0.2,0,0,0]"));
    for (data, body) in [
        ("", format!("h=[-0.2,-0.2]\n{}", go("p[0,0,h[1],0,0,0]"))),
        ("", format!("h=0.2\n{}", go("p[0,0,-norm(h),0,0,0]"))),
        (
            "def deep(d):\nreturn 2*d\nend\n",
            go("p[0,0,deep(-0.1),0,0,0]"),
        ),
    ] {
        let done = of_urscript(data, &body);
        if body.contains("norm") {
            refused(&done, &body);
        } else {
            same(&done, &truth, &body);
        }
    }
    let made = format!(
        "t=pose_trans(w,p[0,0,-0.2,0,0,0])\nh=t[2]\n{}",
        go("p[0,0,h,0,0,0]")
    );
    refused(&of_urscript("", &made), &made);
    let either = "if (get_digital_in(1)):\noff=p[0,0,-0.2,0,0,0]\nelse:\noff=p[0,0,0,0,0,0]\nend\n";
    let either = of_urscript("", &format!("{either}{}", go("off")));
    assert_eq!(
        errors(&either),
        ["displacement-unknown"],
        "{:?}",
        either.findings
    );
    assert!(
        unknown(&either)[0] >= misses(&truth)[0] - 1e-9,
        "{:?}",
        either.findings
    );
    let now = of_urscript(
        "",
        &format!("off=get_actual_tool_flange_pose()\n{}", go("off")),
    );
    refused(&now, "where the robot is");
    let read = format!("h=read_input_float_register(24)\n{}", go("p[0,0,h,0,0,0]"));
    sensed(&of_urscript("", &read), "of a sensor");
}
