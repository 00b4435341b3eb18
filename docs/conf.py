"""Sphinx: the built documentation. docs/build.sh runs it on a copy of this folder beside generated pages."""
import html
import pathlib
import re

from docutils import nodes
from docutils.utils.math import latex2mathml

project = "plenum"
author = "the authors of plenum"
copyright = author  # noqa: A001
extensions = ["myst_parser", "breathe", "sphinx_copybutton"]
exclude_patterns = ["generate"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # several files have headings that begin at the second level
html_theme = "furo"
html_title = "plenum"
html_copy_source = False
html_show_sphinx = False
html_static_path = ["_static"]
html_css_files = ["plenum.css"]
pygments_style = "default"
pygments_dark_style = "monokai"
html_theme_options = {"source_repository": "", "light_css_variables": {"color-brand-primary": "#0b6bcb",
                                                                       "color-brand-content": "#0b6bcb"}}
copybutton_prompt_text = r"\$ "
copybutton_prompt_is_regexp = True
highlight_language = "none"
breathe_default_project = "plenum"
breathe_domain_by_extension = {"h": "cpp"}
html_math_renderer = "mathml"


def mathml(source, display):
    """MathML, which browsers show without a script."""
    return latex2mathml.tex2mathml(source, inline=not display)


def visit_inline(self, node):
    self.body.append(mathml(node.astext(), False))
    raise nodes.SkipNode


def visit_block(self, node):
    self.body.append(f'<div class="math">{mathml(node.astext(), True)}</div>\n')
    raise nodes.SkipNode


INLINE = re.compile(r"<script>(.*?)</script>", re.S)


def scripts_into_a_file(app, exception):
    """The service lets pages run scripts of files only (Content-Security-Policy): those of the theme move into one."""
    if exception or app.builder.name != "html":
        return
    folder, known = pathlib.Path(app.outdir), {}
    for page in folder.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        root = "../" * (len(page.relative_to(folder).parts) - 1)

        def moved(match, root=root):
            name = known.setdefault(html.unescape(match.group(1).strip()), f"inline_{len(known)}.js")
            return f'<script src="{root}_static/{name}"></script>'

        page.write_text(INLINE.sub(moved, text), encoding="utf-8")
    for script, name in known.items():
        (folder / "_static" / name).write_text(script + "\n", encoding="utf-8")


NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")


def complete_theme(app, exception):
    """Debian's Furo leaves to others what its own files should hold: a script that it imports as a module and that is
    none, and a style at a path of Debian's web server."""
    if exception or app.builder.name != "html":
        return
    static = pathlib.Path(app.outdir) / "_static"
    script, style = static / "scripts" / "furo.js", static / "styles" / "furo.css"
    imported = 'import Gumshoe from "./gumshoe-patched.js";'
    text = script.read_text(encoding="utf-8")
    if text.startswith(imported):
        gumshoe = (static / "scripts" / "gumshoe-patched.js").read_text(encoding="utf-8")
        script.write_text(gumshoe + text.removeprefix(imported), encoding="utf-8")
    text = style.read_text(encoding="utf-8")
    outside = "@import url(/javascript/normalize.css/normalize.css);"
    if text.startswith(outside):
        style.write_text(NORMALIZE.read_text(encoding="utf-8") + text.removeprefix(outside), encoding="utf-8")


def setup(app):
    app.add_html_math_renderer("mathml", inline_renderers=(visit_inline, None), block_renderers=(visit_block, None))
    app.connect("build-finished", scripts_into_a_file)
    app.connect("build-finished", complete_theme)
