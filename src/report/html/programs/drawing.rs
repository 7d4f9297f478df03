//! The page of `compensate` while it is made: a program is read again, once as it was and once as
//! it is written.

use super::{Compensated, SAMPLES, Scenery, add_written, compensate_page};
use crate::check::trace::{Traced, trace};
use crate::compensate::{Compensation, Options};
use crate::model::profile::Profile;
use crate::program::{Language, Source};
use crate::report::html::page::Page;
use crate::task::ProfileFile;
use crate::task::compensate::Header;
use crate::task::meshes::{Loader, Reader};

/// The report while it is made: the program as it was, then as it is written.
pub struct Drawing {
    /// The page.
    pub(crate) page: Page,
    original: Vec<Traced>,
}

impl Drawing {
    /// The program as it was. `read` reads meshes of the robot's bodies.
    #[must_use]
    pub fn begin(
        header: &Header,
        compensation: &Compensation,
        file: &ProfileFile,
        options: &Options,
        read: Reader,
    ) -> Self {
        let profile = &file.profile;
        let original = traced(header.language, header.sources, None, profile, options);
        let mut drawn = profile.clone();
        let mut meshes = Loader::new(read);
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

    /// The page as one HTML file that needs no network; `made` says at its foot when and by what.
    #[must_use]
    pub fn html(&self, made: &str) -> String {
        self.page.html(made)
    }

    /// How many moves were inserted to keep the path near the wanted one.
    pub fn say_inserted(&mut self, moves: usize) {
        if moves > 0 {
            self.page.fact("moves inserted", moves.to_string());
        }
    }

    /// And as it is written.
    pub fn add_written(
        &mut self,
        language: &dyn Language,
        written: &[Source],
        sources: &[Source],
        profile: &Profile,
        options: &Options,
    ) {
        let path = traced(language, written, Some(sources), profile, options);
        add_written(
            &mut self.page,
            &path,
            &self.original,
            options.work_offset.as_ref(),
        );
    }
}

/// The path of a program; none where it cannot be followed, which the findings say.
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
