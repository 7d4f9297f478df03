//! Findings of targets that block them, and remarks that are said once.

use crate::finding::{Finding, Severity};
use crate::program::script::{Place, Remark, RemarkId, Script, short};
use crate::program::{Program, Shape, Source, TargetId};
use foldhash::{HashMap, HashSet, HashSetExt};

/// Collects findings.
pub(super) struct Report<'a, 'p> {
    pub(super) sources: &'a [Source],
    pub(super) program: &'p mut Program,
    /// Remarks of tools and frames, behind those of the script.
    pub(super) remarks: Vec<Remark>,
    pub(super) said: HashSet<(TargetId, &'static str)>,
    pub(super) once: HashSet<(&'static str, Place)>,
    pub(super) places: Vec<(Place, Finding)>,
}

/// Identifiers of the report's own remarks begin here.
pub(super) const OWN_REMARKS: RemarkId = 1 << 31;

impl<'a, 'p> Report<'a, 'p> {
    pub(super) fn new(sources: &'a [Source], program: &'p mut Program) -> Self {
        Self {
            sources,
            program,
            remarks: Vec::new(),
            said: HashSet::new(),
            once: HashSet::new(),
            places: Vec::new(),
        }
    }

    pub(super) fn remark(&mut self, remark: Remark) -> RemarkId {
        self.remarks.push(remark);
        OWN_REMARKS + short(self.remarks.len() - 1)
    }

    pub(super) fn remark_of<'r>(&'r self, script: &'r Script, remark: RemarkId) -> &'r Remark {
        match remark.checked_sub(OWN_REMARKS) {
            Some(own) => &self.remarks[own as usize],
            None => &script.remarks[remark as usize],
        }
    }

    pub(super) fn say(
        &mut self,
        id: &'static str,
        severity: Severity,
        place: Place,
        message: String,
        hint: &str,
    ) {
        if self.once.insert((id, place)) {
            let source = &self.sources[place.file as usize];
            let finding = source.finding(place.offset as usize, id, severity, message, hint);
            self.places.push((place, finding));
        }
    }

    /// A remark at a place, once.
    pub(super) fn say_once(&mut self, remark: &Remark, place: Place) {
        let text = remark.text.to_string();
        self.say(remark.id, remark.severity, place, text, remark.hint);
    }

    /// The target has to stay as it is; `because` is where the program says so. Joint targets stay
    /// unless they are asked for.
    pub(super) fn block(
        &mut self,
        target: TargetId,
        id: &'static str,
        wrong: &str,
        hint: &str,
        because: Option<Place>,
    ) {
        self.block_as(Severity::Error, target, id, wrong, hint, because);
    }

    pub(super) fn block_as(
        &mut self,
        of_pose: Severity,
        target: TargetId,
        id: &'static str,
        wrong: &str,
        hint: &str,
        because: Option<Place>,
    ) {
        if !self.said.insert((target, id)) {
            return;
        }
        let blocked = &mut self.program.targets[target];
        blocked.blocked = true;
        let place = Place {
            file: blocked.file,
            offset: blocked.offset,
        };
        let severity = match blocked.layout.shape {
            Shape::Pose => of_pose,
            Shape::Joints => Severity::Warning,
        };
        let name = blocked.name.as_deref().unwrap_or("target");
        let see = match because.filter(|because| *because != place) {
            None => String::new(),
            Some(because) => {
                let source = &self.sources[because.file as usize];
                let (line, _) = source.line_column(because.offset as usize);
                format!(" (see {} line {line})", source.name)
            }
        };
        let message = format!("{name}: {wrong}{see}");
        let source = &self.sources[place.file as usize];
        let finding = source.finding(place.offset as usize, id, severity, message, hint);
        self.places.push((place, finding));
    }

    /// Adds the findings to those of the reader, by file and place.
    pub(super) fn finish(&mut self) {
        let order: HashMap<&str, usize> = self
            .sources
            .iter()
            .map(|s| s.name.as_str())
            .zip(0..)
            .collect();
        let found = std::mem::take(&mut self.places);
        let findings = &mut self.program.findings;
        findings.extend(found.into_iter().map(|(_, finding)| finding));
        findings
            .sort_by_cached_key(|f| (order.get(f.file.as_str()).copied(), f.line, f.column, f.id));
    }
}
