//! A lesson as a package for learning management systems: SCORM 1.2 (ADL, Content Aggregation Model, 2001), one shareable object.

use std::io::{Cursor, Write as _};

use thiserror::Error;
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::Lesson;

/// Points of 100 from which a system calls a lesson passed.
const MASTERY_SCORE: u32 = 60;

/// The page that makes a package stores it as it is, which saves it the code of a compressor.
const COMPRESSION: CompressionMethod =
    if cfg!(feature = "deflate") { CompressionMethod::DEFLATE } else { CompressionMethod::Stored };

/// Why there is no package.
#[derive(Debug, Error)]
pub enum PackageError {
    /// The page cannot take the lesson up.
    #[error(transparent)]
    Page(#[from] PageError),
    /// The archive cannot be written.
    #[error("the package cannot be made: {0}")]
    Zip(#[from] ZipError),
}

/// Why a page cannot take a lesson up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum PageError {
    /// It loads what would not be in the package.
    #[error("this is not the laboratory as one file, `dist/quadtank.html`, which `make single` builds")]
    NotSingle,
    /// It has a lesson already.
    #[error("this page has a lesson in it already; take the one that `make single` builds")]
    HasLesson,
}

/// The package of a lesson, a zip archive, from the laboratory as one file. The same lesson and page always give the same bytes.
///
/// # Errors
/// [`PackageError`].
pub fn scorm_package(page: &str, lesson: &Lesson) -> Result<Vec<u8>, PackageError> {
    let page = scorm_page(page, lesson)?;
    let options = SimpleFileOptions::default().compression_method(COMPRESSION);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in [("imsmanifest.xml", &scorm_manifest(lesson)), ("index.html", &page)] {
        archive.start_file(name, options)?;
        archive.write_all(text.as_bytes()).map_err(ZipError::from)?;
    }
    Ok(archive.finish()?.into_inner())
}

/// The page of a package, `index.html`: the laboratory as one file, with the lesson in its head.
///
/// # Errors
/// [`PageError`].
fn scorm_page(page: &str, lesson: &Lesson) -> Result<String, PageError> {
    const HEAD_ENDS: &str = "</head>";
    let (head, body) = page.split_once(HEAD_ENDS).ok_or(PageError::NotSingle)?;
    if !head.contains("<html data-single") {
        return Err(PageError::NotSingle);
    }
    if head.contains(" id=\"lesson\"") {
        return Err(PageError::HasLesson);
    }
    // Without `<` nothing ends the element.
    let lesson = serde_json::to_string(lesson).unwrap_or_default().replace('<', "\\u003c");
    let script = format!(r#"<script type="application/json" id="lesson" data-scorm="1">{lesson}</script>"#);
    Ok(format!("{head}{script}{HEAD_ENDS}{body}"))
}

/// The manifest of a package, `imsmanifest.xml`. Its only file besides is `index.html`.
fn scorm_manifest(lesson: &Lesson) -> String {
    let title = escaped(lesson.languages.first().map_or("", |&tongue| lesson.title.shown(tongue)));
    // Ids of lessons may begin with a digit, names in XML may not.
    let id = format!("quadtank-{}", lesson.id);
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<manifest identifier="{id}" version="1.0" xmlns="http://www.imsproject.org/xsd/imscp_rootv1p1p2" xmlns:adlcp="http://www.adlnet.org/xsd/adlcp_rootv1p2">
  <metadata>
    <schema>ADL SCORM</schema>
    <schemaversion>1.2</schemaversion>
  </metadata>
  <organizations default="{id}-organization">
    <organization identifier="{id}-organization">
      <title>{title}</title>
      <item identifier="{id}-item" identifierref="{id}-resource" isvisible="true">
        <title>{title}</title>
        <adlcp:masteryscore>{MASTERY_SCORE}</adlcp:masteryscore>
      </item>
    </organization>
  </organizations>
  <resources>
    <resource identifier="{id}-resource" type="webcontent" adlcp:scormtype="sco" href="index.html">
      <file href="index.html"/>
    </resource>
  </resources>
</manifest>
"#
    )
}

/// A text inside an element of XML, on one line. What XML 1.0 cannot hold becomes a space.
fn escaped(text: &str) -> String {
    let is_allowed = |c: char| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}');
    let plain: String = text.chars().map(|c| if is_allowed(c) { c } else { ' ' }).collect();
    plain.trim().replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use roxmltree::{Document, Node};
    use serde_json::json;

    use super::*;
    use crate::sample::{SMALL, changed, lesson};
    use crate::{fingerprint, read_lesson};

    const PAGE: &str =
        "<!doctype html><html data-single lang=\"en\"><head><title>x</title></head><body></head></body></html>";

    const ROOT: &str = "http://www.imsproject.org/xsd/imscp_rootv1p1p2";
    const ADLCP: &str = "http://www.adlnet.org/xsd/adlcp_rootv1p2";

    /// The element at a path of names, each of which is there once.
    fn at<'a>(document: &'a Document, path: &[&str]) -> Node<'a, 'a> {
        path.iter().fold(document.root_element(), |parent, name| {
            let mut found = parent.children().filter(|node| node.has_tag_name((ROOT, *name)));
            let node = found.next().unwrap_or_else(|| panic!("{name} is not there"));
            assert_eq!(found.count(), 0, "{name} is there twice");
            node
        })
    }

    #[test]
    fn the_manifest_has_one_organization_one_item_and_one_resource() {
        let manifest = scorm_manifest(&lesson());
        let xml = Document::parse(&manifest).unwrap();
        assert!(xml.root_element().has_tag_name((ROOT, "manifest")));
        let text = |path: &[&str]| at(&xml, path).text().unwrap().to_owned();
        assert_eq!(text(&["metadata", "schema"]), "ADL SCORM");
        assert_eq!(text(&["metadata", "schemaversion"]), "1.2");
        let organization = at(&xml, &["organizations", "organization"]);
        assert_eq!(at(&xml, &["organizations"]).attribute("default"), organization.attribute("identifier"));
        let item = at(&xml, &["organizations", "organization", "item"]);
        let resource = at(&xml, &["resources", "resource"]);
        assert_eq!(item.attribute("identifierref"), resource.attribute("identifier"));
        let mastery = item.children().find(|node| node.has_tag_name((ADLCP, "masteryscore"))).unwrap();
        assert_eq!(mastery.text(), Some("60"));
        assert_eq!(resource.attribute((ADLCP, "scormtype")), Some("sco"));
        assert_eq!(resource.attribute("type"), Some("webcontent"));
        assert_eq!(resource.attribute("href"), Some("index.html"));
        assert_eq!(at(&xml, &["resources", "resource", "file"]).attribute("href"), Some("index.html"));
    }

    #[test]
    fn ids_are_names_of_xml_and_there_once() {
        let lesson = read_lesson(changed(&[("/id", json!("3-tanks"))]).as_bytes()).unwrap();
        let manifest = scorm_manifest(&lesson);
        let xml = Document::parse(&manifest).unwrap();
        let mut ids: Vec<_> = xml.descendants().filter_map(|node| node.attribute("identifier")).collect();
        assert_eq!(ids.len(), 4);
        assert!(ids.iter().all(|id| id.starts_with(|c: char| c.is_ascii_alphabetic())), "{ids:?}");
        assert!(ids.iter().all(|id| id.chars().all(|c| c.is_ascii_alphanumeric() || c == '-')), "{ids:?}");
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), 4);
    }

    #[test]
    fn the_title_is_that_of_the_first_language() {
        for (languages, title) in [(json!(["en", "es"]), "Small & <short>"), (json!(["es", "en"]), "Pequeña")] {
            let lesson = read_lesson(changed(&[("/languages", languages)]).as_bytes()).unwrap();
            let manifest = scorm_manifest(&lesson);
            let xml = Document::parse(&manifest).unwrap();
            assert_eq!(at(&xml, &["organizations", "organization", "title"]).text(), Some(title));
            assert_eq!(at(&xml, &["organizations", "organization", "item", "title"]).text(), Some(title));
        }
    }

    #[test]
    fn the_page_has_the_lesson_at_the_end_of_its_head() {
        let page = scorm_page(PAGE, &lesson()).unwrap();
        let (before, after) =
            page.split_once("<script type=\"application/json\" id=\"lesson\" data-scorm=\"1\">").unwrap();
        let (inside, rest) = after.split_once("</script>").unwrap();
        assert_eq!(format!("{before}{rest}"), PAGE);
        assert!(before.ends_with("</title>") && rest.starts_with("</head><body>"));
        let read = read_lesson(inside.as_bytes()).unwrap();
        assert_eq!(read, lesson());
        assert_eq!(fingerprint(&read), fingerprint(&lesson()));
    }

    #[test]
    fn no_text_of_a_lesson_ends_its_element() {
        let hostile = json!("</script><script>alert(1)</script><!--<script>");
        let lesson = read_lesson(changed(&[("/title/en", hostile.clone())]).as_bytes()).unwrap();
        let page = scorm_page(PAGE, &lesson).unwrap();
        assert_eq!(page.matches("<script").count(), 1);
        assert_eq!(page.matches("</script").count(), 1);
        let inside = page.split_once("data-scorm=\"1\">").unwrap().1.split_once("</script>").unwrap().0;
        assert_eq!(read_lesson(inside.as_bytes()).unwrap().title.en.map(|title| json!(title)), Some(hostile));
    }

    #[test]
    fn a_package_holds_manifest_and_page_and_is_always_the_same() {
        let package = scorm_package(PAGE, &lesson()).unwrap();
        assert_eq!(package, scorm_package(PAGE, &lesson()).unwrap());
        let mut archive = zip::ZipArchive::new(Cursor::new(package)).unwrap();
        let names: Vec<String> = archive.file_names().map(|name| name.unwrap().into_owned()).collect();
        assert_eq!(names, ["imsmanifest.xml", "index.html"]);
        let page = std::io::read_to_string(archive.by_name("index.html").unwrap()).unwrap();
        assert_eq!(page, scorm_page(PAGE, &lesson()).unwrap());
        assert!(matches!(scorm_package("", &lesson()), Err(PackageError::Page(PageError::NotSingle))));
    }

    #[test]
    fn other_pages_are_refused() {
        for other in ["", "<html><head></head></html>", "<html data-single>", SMALL] {
            assert_eq!(scorm_page(other, &lesson()), Err(PageError::NotSingle), "{other}");
        }
        let twice = scorm_page(&scorm_page(PAGE, &lesson()).unwrap(), &lesson());
        assert_eq!(twice, Err(PageError::HasLesson));
    }

    proptest! {
        #[test]
        fn any_title_makes_a_manifest(title in prop::collection::vec(any::<char>(), 1..60)) {
            let title: String = title.into_iter().collect();
            let lesson = read_lesson(changed(&[("/title/en", json!(title))]).as_bytes()).unwrap();
            let manifest = scorm_manifest(&lesson);
            prop_assert!(Document::parse(&manifest).is_ok(), "{}", manifest);
        }
    }
}
