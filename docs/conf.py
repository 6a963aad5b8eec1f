# SPDX-License-Identifier: Apache-2.0
"""How Sphinx makes the site of the pages that tools/make_site has laid out; Sphinx reads these names."""
import os
import re
from pathlib import Path

from pygments.lexers.special import TextLexer

SOURCE = Path(os.environ["PIOLA_SITE_PAGES"])

project = "Piola"
copyright = "the Piola developers"  # pylint: disable=redefined-builtin
author = "the Piola developers"
release = re.search(r"project\(Piola VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]

extensions = ["myst_parser", "sphinx.ext.mathjax"]
root_doc = "docs/README"
source_suffix = {".md": "markdown"}
myst_enable_extensions = ["dollarmath", "html_image"]
myst_heading_anchors = 4
nitpicky = True
# Blocks without a language are commands, formulas and answers alike: no colours.
highlight_language = "none"
# Debian's MathJax, which tools/make_site puts beside the pages: nothing is fetched.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML-full"
# It is MathJax 2, for which MyST has no settings: only what stands in elements of these classes is a formula.
myst_update_mathjax = False
mathjax2_config = {"tex2jax": {"processClass": "math", "ignoreClass": "mathjax_ignore|tex2jax_ignore"},
                   "showMathMenu": False, "messageStyle": "none"}

html_theme = "furo"
html_title = f"Piola {release}"
html_static_path = [str(SOURCE / "_static")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False

# The order of the pages: (heading, pages); what a name with * finds is sorted. A page that nothing names is a warning.
CONTENTS = {
    "docs/README": [
        ("Use", ["docs/user/first-hour", "docs/user/axisymmetric-impact", "docs/user/gallery", "docs/user/features",
                 "docs/user/formulations", "docs/user/case-file", "docs/user/*", "cases/README"]),
        ("Theory", ["docs/theory/README"]),
        ("Develop", ["CONTRIBUTING", "docs/developer/architecture", "docs/developer/*", "docs/decisions/README",
                     "bench/README"]),
        ("About", ["README", "CHANGELOG"]),
    ],
    "docs/theory/README": [(None, ["docs/theory/*", "src/piola/formulations/*/README"])],
    "docs/decisions/README": [(None, ["docs/decisions/*"])],
    "cases/README": [(None, ["cases/*/README", "cases/*/*/README"])],
    "bench/README": [(None, ["bench/*/README"])],
}


def found(page, patterns):
    """Pages that the patterns name, each once, without the page itself."""
    names = []
    for pattern in patterns:
        names += sorted(path.relative_to(SOURCE).with_suffix("").as_posix() for path in SOURCE.glob(f"{pattern}.md"))
    return [name for name in dict.fromkeys(names) if name != page]


def add_contents(_app, page, text):
    """Sphinx wants to know the tree of pages; the pages themselves stay as they are."""
    for heading, patterns in CONTENTS.get(page, []):
        caption = f":caption: {heading}\n" if heading else ""
        rows = "".join(f"/{name}\n" for name in found(page, patterns))
        text[0] += f"\n\n```{{toctree}}\n:hidden:\n:maxdepth: 1\n{caption}\n{rows}```\n"
    text[0] = text[0].replace("```math\n", "```{math}\n")  # as GitHub writes a formula


def setup(app):
    app.add_lexer("csv", TextLexer)  # shown as it stands
    app.connect("source-read", add_contents)
