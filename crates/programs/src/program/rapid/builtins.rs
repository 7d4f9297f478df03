//! What the instructions and functions of the language write, and those that write nothing.
//!
//! # Source
//! ABB, Technical reference manual RAPID Instructions, Functions and Data types: the arguments that
//! are described as `VAR`, `INOUT` or `PERS` and take a result.

use super::syntax::Verb;

/// Instructions that write the argument at this position, options not counted.
const WRITERS: &[(&str, u8)] = &[
    ("add", 0),
    ("bitclear", 0),
    ("bitset", 0),
    ("camgetparameter", 2),
    ("camgetresult", 1),
    ("clear", 0),
    ("decr", 0),
    ("fricideval", 0),
    ("getdataval", 1),
    ("getsysdata", 0),
    ("incr", 0),
    ("ivarvalue", 2),
    ("readanybin", 1),
    ("readcfgdata", 2),
    ("readerrdata", 1),
    ("readrawbytes", 1),
    ("tpreaddnum", 0),
    ("tpreadfk", 0),
    ("tpreadnum", 0),
    ("unpackrawbytes", 2),
];

/// Instructions that measure a tool or its load and write it.
const TOOL_WRITERS: &str = "\
    loadid manloadidproc mtoolrotcalib mtooltcpcalib stoolrotcalib stooltcpcalib";

/// Instructions that move nothing and write no target, tool or frame.
const HARMLESS: &str = "\
    accset actevent acteventbuffer aliascamera aliasio aliasioreset bookerrno break cambreak \
    camflush camloadjob camreqimage camsetexposure camsetparameter camsetprogrammode \
    camsetrunmode camstartloadjob camwaitloadjob cancelload checkprogref cleariobuff \
    clearrawbytes clkreset clkstart clkstop close closedir collisiondetect copyfile copyrawbytes \
    corrclear corrcon corrdiscon corrwrite deacteventbuffer ditheract ditherdeact dropsensor \
    dropwobj egmactjoint egmactmove egmactpose egmgetid egmreset egmsetupai egmsetupao \
    egmsetupgi egmsetupltapp egmsetupuc egmstop egmstreamstart egmstreamstop eoffsgoto erase \
    erasemodule errlog errwrite fccalib fccondforce fccondorient fccondpos fccondreorispeed \
    fccondtcpspeed fccondtorque fccondwaitwhile fcrefcircle fcrefforce fcrefline fcrefmoveframe \
    fcrefrot fcrefspiral fcrefsprforcecart fcreftorque fcresetdampingtune fcresetlpfiltertune \
    fcsetdampingtune fcsetlpfiltertune fcspdchgact fcspdchgdeact fcspdchgtunreset fcspdchgtunset \
    fcsupvforce fcsupvorient fcsupvpos fcsupvreorispeed fcsupvtcpspeed fcsupvtorque \
    fricidevaluate fricidinit fricidsetfriclevels gettrapdata hollowwristreset iactunit idelete \
    idisable ienable ierror indamove indcmove inddmove indreset indrmove invertdo iobusstart \
    iodisable ioenable ipathpos ipers irmqmessage isignalai isignalao isignaldi isignaldo \
    isignalgi isignalgo isleep itimer iwatch load makedir mechunitload motionprocessmodeset \
    motionsup moveextj nop open opendir packdnheader packrawbytes pathacclim pathreclstart \
    pathrecstart pathrecstop pathresol procerrrecovery pulsedo readblock removeallcyclicbool \
    removecyclicbool removedir removefile renamefile reset resetppmoved resetretrycount \
    restopath rewind rmqemptyqueue rmqfindslot rmqsendmessage rmqsendwait save savecfgdata \
    scwrite sendevice set setao setdatasearch setdo setgo setsysdata sismoveoff skipwarn \
    socketaccept socketbind socketclose socketconnect socketcreate socketlisten socketreceive \
    socketsend socketsendto softact softdeact speedlimaxis speedlimcheckpoint speedrefresh spyon \
    spystart spystop startload startmove stclose stop stopen stopmove stopmovereset storepath \
    syncmoveoff syncmoveon syncmoveresume syncmovesuspend syncmoveundo systemstopaction \
    testsigndefine testsignreset texttabinstall tpdefaultdi tperase tpshow tpwrite triggcheckio \
    triggdatacopy triggdatareset triggequip triggint triggio triggrampao triggspeed \
    triggstopproc triggtabdef tryint tunereset tuneservo uialphaentry uimsgbox uimsgwrite uishow \
    unload velset waitai waitao waitdi waitdo waitgi waitgo waitload waitrob waitsensor \
    waitsyncmove waitsynctask waittestandset waittime waituntil waitwobj warmstart worldacclim \
    worldzone write writeanybin writebin writeblock writecfgdata writerawbytes writestrbin \
    writevar wzboxdef wzcyldef wzdisable wzdoset wzdosset wzenable wzfree wzhomejointdef \
    wzlimjointdef wzlimsup wzsphdef";

/// Optional arguments of harmless instructions that these show, and do not write.
///
/// # Source
/// ABB, Technical reference manual RAPID Instructions, Functions and Data types, `TPWrite`, `Write`.
const SHOWN: &str = "bool dnum num orient pos";

/// Functions that write the argument at this position.
const WRITING_FUNCTIONS: &[(&str, u8)] = &[("getnextsym", 0), ("strtoval", 1), ("testandset", 0)];

/// Functions that tell where the robot is, or where it is taken to be for joints or a pose.
const ACTUAL_FUNCTIONS: &str = "\
    calcjointt calcrobt cjointt cpos crobt";

/// Functions that write nothing.
const HARMLESS_FUNCTIONS: &str = "\
    abs absdnum acos acosdnum ainput aoutput argname asin asindnum atan atan2 atan2dnum atandnum \
    bitand bitanddnum bitcheck bitcheckdnum bitlsh bitlshdnum bitneg bitnegdnum bitor bitordnum \
    bitrsh bitrshdnum bitxor bitxordnum bytetostr camgetexposure camgetloadedjob camgetname \
    camnumberofresults cdate clkread corrread cos cosdnum ctime ctool cwobj dectohex defaccframe \
    defdframe defframe dim dinput distance dnumtonum dnumtostr dotprod doutput eulerzyx \
    eventtype execlevel exp fcgetforce fcgetprocessdata fcisforcemode fcloadid filesize filetime \
    fssize getaxisdistance getaxismoveduration getmecunitname getmodalpayloadmode \
    getmotorcurrent getmotortorque getnextmechunit getnextoption getserviceinfo getsignalorigin \
    getsysinfo gettaskname gettime gettsstatus getuasstatus ginput ginputdnum goutput \
    goutputdnum hextodec indinpos indspeed iobusstate iounitstate isbrakecheckactive \
    iscyclicbool isfile isleadthrough ismechunitactive ispers isstopmoveact issyncmoveon issysid \
    isvar log10 max maxrobspeed min mirpos modexist modtime modtimednum motionplannerno \
    nonmotionmode numtodnum numtostr opmode orient orientzyx orobt paridposvalid paridrobvalid \
    pathlengthget pathlevel pathrecvalidbwd pathrecvalidfwd pfrestart poseinv posemult posevect \
    pow powdnum present progmemfree quad quaddnum rawbyteslen readbin readdir readmotor readnum \
    readstr readstrbin readvar rmqgetslotname robname robos round rounddnum runmode sin sindnum \
    socketgetstatus socketpeek sqrt sqrtdnum strdigcalc strdigcmp strdigitcmp strfind strlen \
    strmap strmatch strmemb strorder strpart strtobyte tan tandnum taskrunmec taskrunrob \
    tasksinsync testdi testsignread textget texttabfreetouse texttabget triggdatavalid trunc \
    truncdnum type uialphaentry uiclientexist uidnumentry uidnumtune uilistview uimessagebox \
    uinumentry uinumtune validio valtostr vectmagn";

/// Functions whose value is worked out of the numbers that they are given.
const WORKED_OUT: &str = "\
    abs absdnum acos acosdnum asin asindnum atan atan2 atan2dnum atandnum bitand bitanddnum bitlsh \
        bitlshdnum \
    bitneg bitnegdnum bitor bitordnum bitrsh bitrshdnum bitxor bitxordnum cos cosdnum defdframe \
        defframe dim \
    distance dnumtonum dotprod eulerzyx exp log10 max min numtodnum orientzyx poseinv posemult \
        posevect pow powdnum \
    quad quaddnum round rounddnum sin sindnum sqrt sqrtdnum strlen tan tandnum trunc truncdnum \
        vectmagn";

/// Whether the value of a function, in lower case, is worked out of what it is given.
pub(super) fn is_worked_out(name: &str) -> bool {
    has(WORKED_OUT, name)
}

/// Whether an optional argument of a harmless instruction is what that shows: `TPWrite "h="\Num:=h;`
pub(super) fn is_shown(option: &str) -> bool {
    has(SHOWN, &option.to_ascii_lowercase())
}

/// Whether a list of words has one.
fn has(words: &str, word: &str) -> bool {
    words.split_ascii_whitespace().any(|known| known == word)
}

/// The position that a name stands with.
fn position(list: &[(&str, u8)], name: &str) -> Option<u8> {
    let mut found = list.iter().filter(|(known, _)| *known == name);
    found.next().map(|(_, position)| *position)
}

/// What an instruction of the language writes; `None` where the name, in lower case, is none that
/// is known.
pub(super) fn instruction(name: &str) -> Option<Verb> {
    if let Some(at) = position(WRITERS, name) {
        return Some(Verb::Writes(at));
    }
    if has(TOOL_WRITERS, name) {
        return Some(Verb::WritesTool);
    }
    has(HARMLESS, name).then_some(Verb::Harmless)
}

/// What a function does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Known {
    /// It writes nothing.
    Harmless,
    /// It tells where the robot is.
    Actual,
    /// It writes the argument at this position.
    Writes(u8),
    /// It is none of the language.
    Other,
}

/// What a function of this name, in lower case, does if it is one of the language.
pub(super) fn function(name: &str) -> Known {
    if has(HARMLESS_FUNCTIONS, name) {
        Known::Harmless
    } else if has(ACTUAL_FUNCTIONS, name) {
        Known::Actual
    } else {
        position(WRITING_FUNCTIONS, name).map_or(Known::Other, Known::Writes)
    }
}
