//! The page of `compensate` while it is made: a program is read again, once as it was and once as it is written.

use super::files::Files;
use crate::check::trace::{Traced, trace};
use crate::compensate::{Compensation, Options};
use crate::model::profile::Profile;
use crate::program::{Language, Source};
use crate::report::html::page::Page;
use crate::report::html::programs::{Compensated, SAMPLES, Scenery, add_written, compensate_page};
use crate::task::ProfileFile;
use crate::task::compensate::Header;
use crate::task::meshes::Loader;
use std::path::Path;

/// The report while it is made: the program as it was, then as it is written.
pub(super) struct Drawing {
    pub page: Page,
    original: Vec<Traced>,
}

impl Drawing {
    /// The program as it was.
    pub(super) fn begin(
        header: &Header,
        compensation: &Compensation,
        file: &ProfileFile,
        options: &Options,
        files: &Files,
    ) -> Self {
        let profile = &file.profile;
        let original = traced(header.language, header.sources, None, profile, options);
        let mut drawn = profile.clone();
        let read = |path: &Path| files.mesh(path);
        let mut meshes = Loader::new(&read);
        for shape in &mut drawn.shapes {
            // a body whose file is missing is not drawn
            let _ = meshes.load(&mut shape.shape, &file.name);
        }
        let scenery = Scenery {
            profile: &drawn,
            cell: None,
            meshes: &meshes.meshes,
        };
        let page = compensate_page(&Compensated {
            header,
            compensation,
            traced: &original,
            work_offset: options.work_offset.as_ref(),
            scenery: &scenery,
        });
        Self { page, original }
    }

    /// How many moves were inserted to keep the path near the wanted one.
    pub(super) fn tell_inserted(&mut self, moves: usize) {
        if moves > 0 {
            self.page.fact("moves inserted", moves.to_string());
        }
    }

    /// And as it is written.
    pub(super) fn add_written(
        &mut self,
        language: &dyn Language,
        written: &[Source],
        sources: &[Source],
        profile: &Profile,
        options: &Options,
    ) {
        let way = traced(language, written, Some(sources), profile, options);
        add_written(
            &mut self.page,
            &way,
            &self.original,
            options.work_offset.as_ref(),
        );
    }
}

/// The way of a program; none where it cannot be followed, which the findings tell.
fn traced(
    language: &dyn Language,
    sources: &[Source],
    nominal: Option<&[Source]>,
    profile: &Profile,
    options: &Options,
) -> Vec<Traced> {
    let scene = crate::check::Scene::default();
    let subject = crate::check::Subject {
        language,
        sources,
        nominal,
        profile,
        scene: &scene,
    };
    let checked = crate::check::Options {
        given: options.given.clone(),
        ..crate::check::Options::default()
    };
    trace(&subject, &checked, SAMPLES).unwrap_or_default()
}
