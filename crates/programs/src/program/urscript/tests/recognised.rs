//! Files that are called as programs of this language.

use crate::program::urscript::UrScript;
use crate::program::{Language, Settings, Source};

#[test]
fn scripts_that_move_nothing_are_recognised_by_their_ending() {
    let accepted = |text: &str| {
        let source = Source::new("a.script", text.into());
        let is_read = UrScript
            .script(std::slice::from_ref(&source), &Settings::default())
            .is_ok();
        assert_eq!(UrScript.accepts(&source), is_read, "{text}");
        is_read
    };
    for text in [
        "def helper(x):\n  return x+1\nend\n",
        "def wait_for(n):\n  while (get_standard_digital_in(n) == False):\n    sync()\n  end\nend\n",
        "i = 0\nwhile i < 3:\n  i = i + 1\nend\n",
        "# inputs\nglobal start = 2\nglobal stop = 3\n",
        "foo=bar[0]",
    ] {
        assert!(accepted(text), "{text}");
        assert!(!UrScript.recognises(&Source::new("a", text.into())));
    }
    for text in [
        "def helper(x):\n  return x+1\n",
        "def helper(x",
        "x = 1\nfoo=bar[0",
        "",
        "# only a comment\n",
        "\u{7f}ELF \u{1}",
    ] {
        assert!(!accepted(text), "{text}");
    }
}
