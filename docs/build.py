#!/usr/bin/env python3
"""Makes the documentation site: build.py HOUSE_JSON OUT_DIR

HOUSE_JSON is written by cmake into the build folder; the site begins at OUT_DIR/html/index.html.

The pages are docs/index.md, docs/architecture.md and each library's README.md and CHANGELOG.md, in
a copy that Doxygen understands: headings get the names that links of GitHub use, links between the
files become links between the pages, and what stands between `<!-- name -->` and `<!-- /name -->`
is replaced by what is generated. Line numbers stay, so warnings point at the right place.

A header needs `/// @file` and a sentence. Left out: export.h, folders `detail`, namespaces
`detail`, and headers without any `///`, which hold function bodies of another header.

Exit status: 0 made, 1 warnings (all are printed), 77 doxygen is not installed.
"""

import html
import json
import pathlib
import re
import shutil
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parent
AWESOME = pathlib.Path("/usr/share/doxygen-awesome-css")  # Debian's package doxygen-awesome-css
AWESOME_STYLES = ["doxygen-awesome.css", "doxygen-awesome-sidebar-only.css",
                  "doxygen-awesome-sidebar-only-darkmode-toggle.css"]
AWESOME_SCRIPTS = {"doxygen-awesome-darkmode-toggle.js": "DoxygenAwesomeDarkModeToggle",
                   "doxygen-awesome-fragment-copy-button.js": "DoxygenAwesomeFragmentCopyButton"}
HOUSE_PICTURE = ('<a class="house" href="house.svg"><img src="house.svg" '
                 'alt="The rooms of GSLAM by floor, and which may use which"/></a>')
NAMESPACE = """/// @namespace gslam
/// Everything that GSLAM offers. Public types live in an inline namespace of their interface
/// version (`gslam::v1`), which nobody has to write and which these pages leave out.
"""
# Doxygen colours comments and strings of Python; those of CMake and of the shell look the same.
LANGUAGES = {"cmake": "{.py}", "sh": "{.py}", "bash": "{.py}", "text": ""}

FENCE = re.compile(r"^(```+)(\w*)", re.MULTILINE)
DIV = re.compile(r"^</?div.*>$", re.MULTILINE)
HEADING = re.compile(r"^(#+) +(.*)$", re.MULTILINE)
CODE_OR_LINK = re.compile(r"`(?P<code>[^`\n]+)`(?!\])"
                          r"|(?<!!)\[(?P<text>(?:`[^`\n]*`|[^\]`])+)\]\((?P<target>[^)\s]+)\)")
INLINE_NAMESPACE = re.compile(r"^(inline namespace v\d+ {|}  // namespace v\d+)$", re.MULTILINE)
FILE_BRIEF = re.compile(r"^/// @file\n((?:/// [^@\n]+\n)+)", re.MULTILINE)


class Site:
    """What the pages are made from: the facts, and which file became which page."""

    def __init__(self, facts, out):
        self.source = pathlib.Path(facts["source"])
        self.version = facts["version"]
        self.components = facts["components"]
        self.out = out
        self.written = {}  # page as Doxygen reads it: the file it was made from
        self.complaints = []
        self.headings = {}  # name of each heading: how often it was seen
        self.headers = {header: name for component in self.components
                        for header, name in headers_of(component).items()}
        self.header_pages = {header: name for header, name in self.headers.items()
                             if file_brief(header)}
        self.pages = {DOCS / "index.md": "index", self.source / "README.md": "index",
                      DOCS / "architecture.md": "architecture"}
        for component in self.components:
            folder = pathlib.Path(component["folder"])
            self.pages[folder] = page_of(component)
            self.pages[folder / "README.md"] = page_of(component)
            self.pages[folder / "CHANGELOG.md"] = f"changes_{component['name']}"


def page_of(component):
    return f"component_{component['name']}"


def headers_of(component):
    """The headers of a component, each with the name by which it is included."""
    folders = [pathlib.Path(component["folder"]) / "include", pathlib.Path(component["generated"])]
    names = {header: header.relative_to(folder).as_posix()
             for folder in folders for header in sorted(folder.rglob("*.h"))}
    return {header: name for header, name in names.items()
            if header.name != "export.h" and "/detail/" not in name}


def file_brief(header):
    """What a header says of itself; nothing where it only holds function bodies of another one."""
    found = FILE_BRIEF.search(header.read_text(encoding="utf-8"))
    return " ".join(found[1].replace("///", "").split()) if found else ""


# --- from Markdown of GitHub to Markdown of Doxygen

def anchor(page, heading):
    """Name of a heading: what GitHub calls it, made unique by its page."""
    words = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
    return f"{page}_{words}"


def convert(site, source, text):
    """Converts what is not code; fences of code only change the name of their language."""
    parts = re.split(r"(^```.*?^```$)", text, flags=re.DOTALL | re.MULTILINE)
    for i, part in enumerate(parts):
        if i % 2 == 1:
            parts[i] = FENCE.sub(lambda m: m[1] + LANGUAGES.get(m[2], m[2]), part, count=1)
        else:
            parts[i] = convert_prose(site, source, part)
    return "".join(parts)


def convert_prose(site, source, text):
    page = site.pages[source]

    def heading(match):
        if page == "index":  # its parts are no entries of the tree on the left
            return match[0] if match[1] == "#" else f"<h2>{match[2]}</h2>"
        if match[1] == "#":
            return f"{match[0]} {{#{page}}}"
        name = anchor(page, match[2])
        repeats = site.headings.setdefault(name, 0)
        site.headings[name] += 1
        # GitHub numbers the repeats of a heading in the same way.
        return f"{match[0]} {{#{name}{f'-{repeats}' if repeats else ''}}}"

    def code_or_link(match):
        if match["code"]:
            is_header = match["code"] in site.header_pages.values()
            return page_link(match["code"], match["code"]) if is_header else match[0]
        return link(site, source, match["text"], match["target"])

    text = DIV.sub(r"@htmlonly[block]\g<0>@endhtmlonly", CODE_OR_LINK.sub(code_or_link, text))
    return HEADING.sub(heading, text)


def link(site, source, text, target):
    """A link between files as one between pages; plain text where the site has no such page."""
    if re.match(r"[a-z]+:|@ref", target):
        return f"[{text}]({target})"
    path, _, heading = target.partition("#")
    file = (source.parent / path).resolve() if path else source
    if file in site.pages:
        page = site.pages[file]
        return page_link(text, f"{page}_{heading}" if heading else page)
    if file in site.header_pages:
        return page_link(text, site.header_pages[file])
    if not file.exists():
        site.complaints.append(f"{source}: link to {target}: there is no such file")
    return text


def page_link(text, page):
    """A link as Doxygen has it; it knows no code in the text of a link."""
    return f"[{text.replace('`', '')}](@ref {page})"


def fill(text, name, content):
    """Replaces what stands between two markers by one line, and keeps the number of lines."""
    before, _, rest = text.partition(f"<!-- {name} -->")
    old, _, after = rest.partition(f"<!-- /{name} -->")
    return before + content + "\n" * old.count("\n") + after


# --- what is generated

def row(tag, *contents):
    return "<tr>" + "".join(f"<{tag}>{content}</{tag}>" for content in contents) + "</tr>"


def component_table(site):
    rows = [row("th", "component", "version", "what it is")]
    for component in site.components:
        rows.append(row("td", f"@subpage {page_of(component)} \"{component['name']}\"",
                        component["version"], html.escape(component["summary"])))
    return f'<table class="markdownTable">{"".join(rows)}</table>'


def facts_line(component):
    """Version, target, kind, dependencies and changes of a component, in one line."""
    kind = "headers only" if component["kind"] == "headers" else component["kind"]
    facts = [f"version {component['version']}", f"<code>GSLAM::{component['name']}</code>",
             f"{kind}, C++{component['standard']}"]
    uses = [f"@ref component_{name} \"{name}\" {least}"
            for name, least in component["depends"].items()]
    facts.append("uses " + ", ".join(uses) if uses else "uses nothing else of GSLAM")
    if (pathlib.Path(component["folder"]) / "CHANGELOG.md").exists():
        facts.append(f"@subpage changes_{component['name']} \"changes\"")
    return '<div class="facts">' + " · ".join(facts) + "</div>"


def reference(site, component):
    """The section that leads from a component's page to its headers."""
    lines = [f"\n## Reference {{#{page_of(component)}_reference}}\n",
             "| header | content |", "| --- | --- |"]
    for header, name in headers_of(component).items():
        if header in site.header_pages:
            brief = file_brief(header).replace("|", "\\|")
            lines.append(f"| {page_link(name, name)} | {brief} |")
    return "\n".join(lines) + "\n"


# --- pages

def write_page(site, source, text):
    page = site.out / "pages" / f"{site.pages[source]}.md"
    page.write_text(text, encoding="utf-8")
    site.written[page] = source


def write_docs_page(site, name, marker, content):
    source = DOCS / name
    text = fill(source.read_text(encoding="utf-8"), marker, content)
    write_page(site, source, convert(site, source, text))


def write_headers(site):
    """Copies the headers into one tree, without the inline namespaces of the interface version."""
    for header, name in site.headers.items():
        text = INLINE_NAMESPACE.sub("", header.read_text(encoding="utf-8"))
        copy = site.out / "include" / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(text, encoding="utf-8")
        site.written[copy] = header
        if "///" in text and header not in site.header_pages:
            site.complaints.append(f"{header}:1: has no `/// @file` with a sentence under it")


def write_component_pages(site, component):
    readme = pathlib.Path(component["folder"]) / "README.md"
    text = f"# GSLAM::{component['name']}\n\n{component['summary']}.\n"
    if readme.exists():
        text = readme.read_text(encoding="utf-8")
    title, _, rest = convert(site, readme, text).partition("\n")
    text = f"{title}\n{facts_line(component)}{rest}{reference(site, component)}"
    write_page(site, readme, text)
    changes = readme.with_name("CHANGELOG.md")
    if changes.exists():
        write_page(site, changes, convert(site, changes, changes.read_text(encoding="utf-8")))


def write_input(site):
    for folder in ("html", "include", "pages"):
        shutil.rmtree(site.out / folder, ignore_errors=True)
        (site.out / folder).mkdir(parents=True)
    subprocess.run([sys.executable, DOCS / "house.py", site.source / "cmake" / "rooms.json",
                    site.out / "pages" / "house.svg"], check=True, stdout=subprocess.DEVNULL)
    write_docs_page(site, "index.md", "components", component_table(site))
    write_docs_page(site, "architecture.md", "house", HOUSE_PICTURE)
    for component in site.components:
        write_component_pages(site, component)
    write_headers(site)
    (site.out / "pages" / "namespace.dox").write_text(NAMESPACE, encoding="utf-8")


# --- Doxygen

def quoted(values):
    return " ".join(f'"{value}"' for value in values)


def write_header(site):
    """Doxygen's own page header, with the scripts of doxygen-awesome-css in it."""
    header = site.out / "header.html"
    subprocess.run(["doxygen", "-w", "html", header, "footer.html", "unused.css"],
                   check=True, cwd=site.out, stdout=subprocess.DEVNULL)
    scripts = "".join(f'<script type="text/javascript" src="$relpath^{file}"></script>\n'
                      f'<script type="text/javascript">{name}.init()</script>\n'
                      for file, name in AWESOME_SCRIPTS.items())
    page = header.read_text(encoding="utf-8")
    header.write_text(page.replace("</head>", scripts + "</head>"), encoding="utf-8")
    return header


def write_doxyfile(site):
    styles, files, header = [DOCS / "style.css"], [site.out / "pages" / "house.svg"], ""
    if AWESOME.is_dir():
        styles = [AWESOME / style for style in AWESOME_STYLES] + styles
        files += [AWESOME / script for script in AWESOME_SCRIPTS]
        header = write_header(site)
    compiled = [c["name"].upper() for c in site.components if c["kind"] == "compiled"]
    values = {"DOCS": DOCS, "OUT": site.out, "VERSION": site.version, "HEADER": header,
              "STYLES": quoted(styles), "FILES": quoted(files),
              "EXPORTS": quoted(f"GSLAM_{name}_EXPORT=" for name in compiled)}
    text = (DOCS / "Doxyfile.in").read_text(encoding="utf-8")
    for name, value in values.items():
        text = text.replace(f"@{name}@", str(value))
    doxyfile = site.out / "Doxyfile"
    doxyfile.write_text(text, encoding="utf-8")
    return doxyfile


def run_doxygen(site):
    """Runs Doxygen; returns its warnings, which name the files that people edit."""
    result = subprocess.run(["doxygen", write_doxyfile(site)], text=True, check=False,
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    output = result.stderr
    for page, source in site.written.items():
        output = output.replace(str(page), str(source))
    warnings = list(dict.fromkeys(re.split(r"\n(?=/)", output.strip()))) if output.strip() else []
    if result.returncode != 0 and not warnings:
        warnings = [f"doxygen ended with {result.returncode}"]
    return warnings


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    if not shutil.which("doxygen"):
        print("No documentation is made: doxygen is not installed.")
        return 77
    facts = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    site = Site(facts, pathlib.Path(sys.argv[2]).resolve())
    write_input(site)
    warnings = site.complaints + run_doxygen(site)
    if warnings:
        print("\n".join(warnings))
        print(f"{len(warnings)} warnings: the documentation is not in order")
        return 1
    if not AWESOME.is_dir():
        print("doxygen-awesome-css is not installed: the site has Doxygen's own look")
    print(site.out / "html" / "index.html")
    return 0


if __name__ == "__main__":
    sys.exit(main())
