// Structure of YAML: the examples of the specification, names, aliases, merge keys, documents.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parse_error.h"

namespace {

using gslam::parseJson;
using gslam::parseYaml;
using gslam::parseYamlDocuments;
using gslam::Svar;
using parse_error::yamlError;

struct YamlAsJson {
  const char* name;
  const char* yaml;
  const char* json;
};

// The examples of chapter 2, "Language Overview", with values as by the core schema.
const YamlAsJson kExamples[] = {
    {"2.1", "- Mark McGwire\n- Sammy Sosa\n- Ken Griffey\n",
     R"(["Mark McGwire", "Sammy Sosa", "Ken Griffey"])"},
    {"2.2", "hr:  65    # Home runs\navg: 0.278 # Batting average\nrbi: 147   # Runs Batted In\n",
     R"({"hr": 65, "avg": 0.278, "rbi": 147})"},
    {"2.3",
     "american:\n- Boston Red Sox\n- Detroit Tigers\nnational:\n- New York Mets\n- Chicago Cubs\n",
     R"({"american": ["Boston Red Sox", "Detroit Tigers"], "national": ["New York Mets", "Chicago Cubs"]})"},
    {"2.4", "-\n  name: Mark McGwire\n  hr:   65\n-\n  name: Sammy Sosa\n  hr:   63\n",
     R"([{"name": "Mark McGwire", "hr": 65}, {"name": "Sammy Sosa", "hr": 63}])"},
    {"2.5", "- [name        , hr, avg  ]\n- [Mark McGwire, 65, 0.278]\n",
     R"([["name", "hr", "avg"], ["Mark McGwire", 65, 0.278]])"},
    {"2.6",
     "Mark McGwire: {hr: 65, avg: 0.278}\nSammy Sosa: {\n    hr: 63,\n    avg: 0.288,\n  }\n",
     R"({"Mark McGwire": {"hr": 65, "avg": 0.278}, "Sammy Sosa": {"hr": 63, "avg": 0.288}})"},
    {"2.9", "---\nhr: # 1998 hr ranking\n- Mark McGwire\n- Sammy Sosa\nrbi:\n- Sammy Sosa\n",
     R"({"hr": ["Mark McGwire", "Sammy Sosa"], "rbi": ["Sammy Sosa"]})"},
    {"2.10",
     "---\nhr:\n- Mark McGwire\n# Following node labeled SS\n- &SS Sammy Sosa\nrbi:\n- *SS\n",
     R"({"hr": ["Mark McGwire", "Sammy Sosa"], "rbi": ["Sammy Sosa"]})"},
    {"2.12",
     "---\n# Products purchased\n- item    : Super Hoop\n  quantity: 1\n- item    : Basketball\n"
     "  quantity: 4\n",
     R"([{"item": "Super Hoop", "quantity": 1}, {"item": "Basketball", "quantity": 4}])"},
    {"2.13", "# ASCII Art\n--- |\n  \\//||\\/||\n  // ||  ||__\n",
     R"("\\//||\\/||\n// ||  ||__\n")"},
    {"2.14", "--- >\n  Mark McGwire's\n  year was crippled\n  by a knee injury.\n",
     R"("Mark McGwire's year was crippled by a knee injury.\n")"},
    {"2.15",
     "--- >\n Sammy Sosa completed another\n fine season with great stats.\n\n   63 Home Runs\n"
     "   0.288 Batting Average\n\n What a year!\n",
     R"("Sammy Sosa completed another fine season with great stats.\n\n  63 Home Runs\n  0.288 Batting Average\n\nWhat a year!\n")"},
    {"2.16",
     "name: Mark McGwire\naccomplishment: >\n  Mark set a major league\n  home run record.\nstats: "
     "|\n"
     "  65 Home Runs\n  0.278 Batting Average\n",
     R"({"name": "Mark McGwire", "accomplishment": "Mark set a major league home run record.\n", "stats": "65 Home Runs\n0.278 Batting Average\n"})"},
    {"2.17",
     "unicode: \"Sosa did fine.\\u263A\"\ncontrol: \"\\b1998\\t1999\\t2000\\n\"\n"
     "hex esc: \"\\x0d\\x0a is \\r\\n\"\n\nsingle: '\"Howdy!\" he cried.'\n"
     "quoted: ' # Not a ''comment''.'\ntie-fighter: '|\\-*-/|'\n",
     R"({"unicode": "Sosa did fine.\u263A", "control": "\b1998\t1999\t2000\n", "hex esc": "\r\n is \r\n", "single": "\"Howdy!\" he cried.", "quoted": " # Not a 'comment'.", "tie-fighter": "|\\-*-/|"})"},
    {"2.18",
     "plain:\n  This unquoted scalar\n  spans many lines.\n\nquoted: \"So does this\n  quoted "
     "scalar.\\n\"\n",
     R"({"plain": "This unquoted scalar spans many lines.", "quoted": "So does this quoted scalar.\n"})"},
    {"2.19", "canonical: 12345\ndecimal: +12345\noctal: 0o14\nhexadecimal: 0xC\n",
     R"({"canonical": 12345, "decimal": 12345, "octal": 12, "hexadecimal": 12})"},
    {"2.20", "canonical: 1.23015e+3\nexponential: 12.3015e+02\nfixed: 1230.15\n",
     R"({"canonical": 1230.15, "exponential": 1230.15, "fixed": 1230.15})"},
    {"2.21", "null:\nbooleans: [ true, false ]\nstring: '012345'\n",
     R"({"null": null, "booleans": [true, false], "string": "012345"})"},
    {"2.22", "iso8601: 2001-12-14t21:59:43.10-05:00\ndate: 2002-12-14\n",
     R"({"iso8601": "2001-12-14t21:59:43.10-05:00", "date": "2002-12-14"})"},
    {"2.23", "---\nnot-date: !!str 2002-04-28\n\nspecific: !something |\n The semantics\n\n",
     R"({"not-date": "2002-04-28", "specific": "The semantics\n"})"},
    {"2.24",
     "%TAG ! tag:clarkevans.com,2002:\n--- !shape\n- !circle\n  center: &ORIGIN {x: 73, y: 129}\n"
     "  radius: 7\n- !line\n  start: *ORIGIN\n",
     R"([{"center": {"x": 73, "y": 129}, "radius": 7}, {"start": {"x": 73, "y": 129}}])"},
    {"2.25", "--- !!set\n? Mark McGwire\n? Sammy Sosa\n",
     R"({"Mark McGwire": null, "Sammy Sosa": null})"},
    {"2.26", "--- !!omap\n- Mark McGwire: 65\n- Sammy Sosa: 63\n",
     R"([{"Mark McGwire": 65}, {"Sammy Sosa": 63}])"},
    {"2.27",
     "--- !<tag:clarkevans.com,2002:invoice>\nbill-to: &id001\n    given  : Chris\n    address:\n"
     "        lines: |\n            458 Walkman Dr.\n            Suite #292\n        postal  : "
     "48046\n"
     "ship-to: *id001\ntax  : 251.42\ncomments:\n    Late afternoon is best.\n    Backup contact "
     "is\n"
     "    Nancy.\n",
     R"({"bill-to": {"given": "Chris", "address": {"lines": "458 Walkman Dr.\nSuite #292\n", "postal": 48046}},
         "ship-to": {"given": "Chris", "address": {"lines": "458 Walkman Dr.\nSuite #292\n", "postal": 48046}},
         "tax": 251.42, "comments": "Late afternoon is best. Backup contact is Nancy."})"},
    // Chapter 10, the schemas.
    {"10.1",
     "Block style: !!map\n  Clark : Evans\n  Ingy  : net\nFlow style: !!map { Clark: Evans }\n",
     R"({"Block style": {"Clark": "Evans", "Ingy": "net"}, "Flow style": {"Clark": "Evans"}})"},
    {"10.2", "Block style: !!seq\n- Clark Evans\n- Ingy\nFlow style: !!seq [ Clark Evans, Ingy ]\n",
     R"({"Block style": ["Clark Evans", "Ingy"], "Flow style": ["Clark Evans", "Ingy"]})"},
    {"10.3",
     "Block style: !!str |-\n  String: just a theory.\nFlow style: !!str \"String: just a "
     "theory.\"\n",
     R"({"Block style": "String: just a theory.", "Flow style": "String: just a theory."})"},
    {"10.4", "!!null null: value for null key\nkey with null value: !!null null\n",
     R"({"null": "value for null key", "key with null value": null})"},
    {"10.6", "negative: !!int -12\nzero: !!int 0\npositive: !!int 34\n",
     R"({"negative": -12, "zero": 0, "positive": 34})"},
    {"10.9",
     "A null: null\nBooleans: [ true, True, false, FALSE ]\nIntegers: [ 0, 0o7, 0x3A, -19 ]\n"
     "Floats: [ 0., -0.0, .5, +12e03, -2E+05 ]\n",
     R"({"A null": null, "Booleans": [true, true, false, false], "Integers": [0, 7, 58, -19],
         "Floats": [0.0, -0.0, 0.5, 12000.0, -200000.0]})"},
};

TEST(YamlStructure, ExamplesOfTheSpecification) {
  for (const YamlAsJson& one : kExamples) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(parseYaml(one.yaml), parseJson(one.json));
  }
}

const YamlAsJson kOthers[] = {
    {"nested_blocks", "- - 1\n  - 2\n- a: 1\n  b:\n  - c\n-\n",
     R"([[1, 2], {"a": 1, "b": ["c"]}, null])"},
    {"compact_members", "[a: 1, b, ? c : 2]", R"([{"a": 1}, "b", {"c": 2}])"},
    {"flow_over_lines", "{a: [1,\n  2,\n  ], \"b\":3,\n c: , d}",
     R"({"a": [1, 2], "b": 3, "c": null, "d": null})"},
    {"json", R"({"a":[1,{"b":null}],"c":"d\n"})", R"({"a":[1,{"b":null}],"c":"d\n"})"},
    {"explicit_names", "? a\n: 1\n? b\n", R"({"a": 1, "b": null})"},
    {"names_are_text", "1: a\n2.50: b\ntrue: c\n0x10: d\n'q': e\n!!int 7: f\n",
     R"({"1": "a", "2.50": "b", "true": "c", "0x10": "d", "q": "e", "7": "f"})"},
    {"names_of_null", "null: 1\n~: 2\n: 3\nNULL: 4", R"({"null": 1, "~": 2, "": 3, "NULL": 4})"},
    {"dots_in_names", "Camera.fx: 517.3\n", R"({"Camera.fx": 517.3})"},
    {"empty", "[[], {}, '', ]", R"([[], {}, ""])"},
    {"crlf", "a: 1\r\nb:\r\n  - 2\r\n", R"({"a": 1, "b": [2]})"},
    {"byte_order_mark",
     "\xEF\xBB\xBF"
     "a: 1",
     R"({"a": 1})"},
    {"colon_in_text", "a: http://b:80/c#d\n", R"({"a": "http://b:80/c#d"})"},
    {"comment_needs_a_space", "a: b#c #d", R"({"a": "b#c"})"},
    {"anchored_name", "&x a: 1\nb: *x\n*x : 2", R"({"a": 2, "b": "a"})"},
    {"anchored_null_name", "&x ~: 1\nb: *x", R"({"~": 1, "b": null})"},
    {"anchor_again", "[&x 1, *x, &x 2, *x]", "[1, 1, 2, 2]"},
    {"anchored_empty", "a: &x\nb: *x", R"({"a": null, "b": null})"},
};

TEST(YamlStructure, Others) {
  gslam::YamlOptions options;
  options.allow_duplicate_names = true;
  for (const YamlAsJson& one : kOthers) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(parseYaml(one.yaml, "YAML", options), parseJson(one.json));
  }
}

TEST(YamlStructure, OrderOfMembersIsKept) {
  EXPECT_EQ(gslam::printJson(parseYaml("c: 1\na: 2\nb: 3")), R"({"c":1,"a":2,"b":3})");
}

// The object was made inside of the library, which may be a shared one, and is asked here.
TEST(YamlStructure, ManyNamesAreFound) {
  std::string yaml, xml = "<a>";
  for (int i = 0; i < 100; ++i) {
    const std::string number = std::to_string(i);
    yaml += "n" + number + ": " + number + "\n";
    xml += "<n" + number + ">" + number;
    xml += "</n" + number + ">";
  }
  for (const Svar& value : {parseYaml(yaml), gslam::parseXml(xml + "</a>")}) {
    for (int i = 0; i < 100; ++i) EXPECT_EQ(value.get<int>("n" + std::to_string(i), -1), i);
  }
}

TEST(YamlStructure, AliasesAreCopies) {
  const Svar value = parseYaml("a: &x {k: [1]}\nb: *x\nc: *x\n");
  Svar list = value["b"]["k"];
  list.push_back(2);
  EXPECT_EQ(value, parseJson(R"({"a": {"k": [1]}, "b": {"k": [1, 2]}, "c": {"k": [1]}})"));
}

TEST(YamlStructure, MergeKeys) {
  const YamlAsJson cases[] = {
      {"one", "x: &x {a: 1, b: 2}\ny:\n  <<: *x\n  b: 3\n",
       R"({"x": {"a": 1, "b": 2}, "y": {"a": 1, "b": 3}})"},
      {"own_names_before", "x: &x {a: 1, b: 2}\ny:\n  b: 3\n  <<: *x\n",
       R"({"x": {"a": 1, "b": 2}, "y": {"b": 3, "a": 1}})"},
      {"the_first_wins", "- &x {a: 1}\n- &y {a: 2, b: 2}\n- {<<: [*x, *y], c: 3}\n",
       R"([{"a": 1}, {"a": 2, "b": 2}, {"c": 3, "a": 1, "b": 2}])"},
      {"in_place", "<<: {a: 1}\nb: 2", R"({"b": 2, "a": 1})"},
      {"of_merged", "- &x {a: 1}\n- &y {<<: *x, b: 2}\n- <<: *y\n",
       R"([{"a": 1}, {"b": 2, "a": 1}, {"a": 1, "b": 2}])"},
      {"empty", "<<: []\na: 1", R"({"a": 1})"},
      {"quoted_is_a_name", "'<<': {a: 1}", R"({"<<": {"a": 1}})"},
      {"anchored_inside", "a: {<<: &x {k: [1]}}\nb: *x", R"({"a": {"k": [1]}, "b": {"k": [1]}})"},
  };
  for (const YamlAsJson& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(parseYaml(one.yaml), parseJson(one.json));
  }
  EXPECT_EQ(gslam::printJson(parseYaml("{<<: {a: 1}, b: 2}")), R"({"b":2,"a":1})");
  const std::string expected =
      "1:1: expected an object, or an array of objects, to merge by \"<<\"";
  EXPECT_EQ(yamlError("<<: 1"), expected);
  EXPECT_EQ(yamlError("<<: [{a: 1}, 2]"), expected);
  EXPECT_EQ(yamlError("<<: {a: 1}\n<<: {b: 1}"),
            "2:1: expected each name once, found \"<<\" also at line 1, column 1");
}

TEST(YamlStructure, DuplicateNames) {
  EXPECT_EQ(yamlError("a: 1\nb: {c: 1,\n  c: 2}\n"),
            "3:3: expected each name once, found \"c\" also at line 2, column 5");
  EXPECT_EQ(yamlError("1: a\n'1': b"),
            "2:1: expected each name once, found \"1\" also at line 1, column 1");
  gslam::YamlOptions options;
  options.allow_duplicate_names = true;
  EXPECT_EQ(gslam::printJson(parseYaml("a: 1\nb: 2\na: 3", "YAML", options)), R"({"a":3,"b":2})");
  EXPECT_EQ(parseYaml("{<<: {a: 1, b: 1}, <<: {b: 2, c: 2}}", "YAML", options),
            parseJson(R"({"a": 1, "b": 1, "c": 2})"));
}

TEST(YamlStructure, Documents) {
  using List = std::vector<Svar>;
  EXPECT_EQ(parseYamlDocuments("---\na: 1\n---\n- 2\n...\n# c\n--- 3\n"),
            (List{Svar::object({{"a", 1}}), Svar::array({2}), Svar(3)}));
  EXPECT_EQ(parseYamlDocuments("a\n...\nb"), (List{Svar("a"), Svar("b")}));
  EXPECT_EQ(parseYamlDocuments("---\n---\n"), (List{Svar(), Svar()}));
  EXPECT_EQ(parseYamlDocuments("%YAML 1.2\n---\na\n...\n%YAML 1.2\n--- b"),
            (List{Svar("a"), Svar("b")}));
  EXPECT_EQ(parseYamlDocuments("--- >\n a\n--- |\n ---\n"), (List{Svar("a\n"), Svar("---\n")}));
  for (const char* const none : {"", "\n\n", "# comment", "...", "...\n...\n", "  # c\n...\n"}) {
    EXPECT_EQ(parseYamlDocuments(none), List()) << none;
  }
  EXPECT_EQ(parseYaml("a\n...\n"), Svar("a"));
  EXPECT_EQ(parseYaml("...\n---\na\n..."), Svar("a"));
  EXPECT_EQ(parseYaml("---"), Svar());
  EXPECT_EQ(yamlError("---\na\n---\nb"),
            "3:1: expected one document, found a second one; parseYamlDocuments() reads them all");
  EXPECT_EQ(parse_error::errorOf([] { parseYamlDocuments("a\n...\n,"); }),
            "3:1: expected a value, found ','");
  EXPECT_EQ(yamlError(""), "1:1: expected a document, found nothing");
  EXPECT_EQ(yamlError("# only\n"), "2:1: expected a document, found nothing");
}

TEST(YamlStructure, AnchorsAreThoseOfTheirDocument) {
  EXPECT_EQ(parse_error::errorOf([] { parseYamlDocuments("- &x 1\n---\n- *x\n"); }),
            "3:3: cannot be read as YAML: the referenced anchor is not defined");
}

}  // namespace
