//! Reports to look at: one HTML file that holds all it needs and asks nothing of a network.
//!
//! A command gives a [`Page`](page::Page): a title, a verdict, a few numbers, tables, and sections
//! that show columns of these tables as charts or in space. [`page`] writes it as HTML; what draws
//! it in the browser is one script, built of `web/` at the top of the repository and kept built in
//! `assets/`. One file for each kind of page: [`programs`], [`measurements`], [`diagnosis`],
//! [`frames`], [`axes`], [`plan`], [`reach`].
//!
//! # Safety of what is shown
//! Names come from files that anybody may have written. They are escaped; the data are JSON in
//! which no markup can begin or end; the script makes text of them, never markup; and a content
//! security policy lets the page run that one script and ask for nothing.

pub(crate) mod axes;
pub(crate) mod cell;
mod chart;
pub(crate) mod diagnosis;
pub(crate) mod frames;
pub(crate) mod measurements;
pub(crate) mod numbers;
pub(crate) mod page;
pub(crate) mod plan;
pub(crate) mod programs;
pub(crate) mod reach;
