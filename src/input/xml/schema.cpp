#include "input/xml/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "input/design_limits.h"
#include "input/xml/number.h"
#include "input/xml/read.h"
#include "input/xml/units.h"
#include "input/xml/values.h"
#include "popup/mechanism.h"

namespace popup::xml {
namespace {

constexpr std::string_view kHead = R"xsd(<?xml version="1.0" encoding="UTF-8"?>
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" version="3.0">
  <xs:annotation>
    <xs:documentation>
      The popup XML document in its canonical spelling: what popupc writes. It reads more generous spellings, too.
      Lengths are in the document's units. The origin is the centre of the page, x points right, y up.
      Page 0 is the base page; each glued element of the list adds one page for its piece, numbered from 1.
      What this schema cannot say: the number of outer points depends on the type, as the types tell; a parent fold
      must be there when its structure is reached; the id "page" is kept.
    </xs:documentation>
  </xs:annotation>

  <xs:element name="popup">
    <xs:complexType>
      <xs:sequence>
        <xs:element name="mainpage" type="mainpage" minOccurs="0"/>
        <xs:element name="structurelist" minOccurs="0">
          <xs:complexType>
            <xs:sequence>
              <xs:element name="structure" type="structure" minOccurs="0" maxOccurs="unbounded"/>
            </xs:sequence>
          </xs:complexType>
          <xs:unique name="ids">
            <xs:selector xpath="structure"/>
            <xs:field xpath="@id"/>
          </xs:unique>
        </xs:element>
        <xs:element name="drawnlinelist" minOccurs="0">
          <xs:complexType>
            <xs:choice minOccurs="0" maxOccurs="unbounded">
              <xs:element name="drawnline" type="drawnline"/>
              <xs:element name="image" type="image"/>
              <xs:element name="text" type="text"/>
              <xs:element name="area" type="area"/>
            </xs:choice>
          </xs:complexType>
        </xs:element>
      </xs:sequence>
      <xs:attribute name="version" default="2.0">
        <xs:simpleType>
          <xs:restriction base="xs:string">
            <xs:enumeration value="2.0"/>
            <xs:enumeration value="3.0"/>
          </xs:restriction>
        </xs:simpleType>
      </xs:attribute>
)xsd";

constexpr std::string_view kStructure = R"xsd(
  <xs:complexType name="structure">
    <xs:sequence>
      <xs:element name="outerpoints"{}>
        <xs:complexType>
          <xs:sequence>
            <xs:element name="point" type="pagepoint" minOccurs="{}" maxOccurs="{}"/>
          </xs:sequence>
        </xs:complexType>
      </xs:element>
{}{}    </xs:sequence>
    <xs:attribute name="type" type="type" use="required"/>
    <xs:attribute name="id" type="id"/>
{}  </xs:complexType>

  <xs:complexType name="drawnline">
    <xs:sequence>
      <xs:element name="point" type="point" minOccurs="2" maxOccurs="unbounded"/>
    </xs:sequence>
    <xs:attribute name="page" type="page" default="0"/>
    <xs:attribute name="thickness" default="1">
      <xs:annotation>
        <xs:documentation>In points of 1/72 inch, whatever the units of the document.</xs:documentation>
      </xs:annotation>
      <xs:simpleType>
        <xs:restriction base="number">
          <xs:minInclusive value="0"/>
          <xs:maxInclusive value="{}"/>
        </xs:restriction>
      </xs:simpleType>
    </xs:attribute>
    <xs:attribute name="color" type="color" default="#000000"/>
  </xs:complexType>

  <xs:complexType name="image">
    <xs:annotation>
      <xs:documentation>A PNG or JPEG file below the folder of the document, in a rectangle with its lower left corner at (x, y).
        One of width and height is enough: the other follows from the picture.</xs:documentation>
    </xs:annotation>
    <xs:attribute name="href" type="xs:string" use="required"/>
    <xs:attributeGroup ref="place"/>
    <xs:attribute name="width" type="size"/>
    <xs:attribute name="height" type="size"/>
    <xs:attribute name="fit" default="stretch">
      <xs:simpleType>
        <xs:restriction base="xs:string">
{}        </xs:restriction>
      </xs:simpleType>
    </xs:attribute>
    <xs:attribute name="horizon">
      <xs:annotation>
        <xs:documentation>Where in the picture its horizon is: 0 at the lower edge, 1 at the upper one.</xs:documentation>
      </xs:annotation>
      <xs:simpleType>
        <xs:restriction base="number">
          <xs:minInclusive value="0"/>
          <xs:maxInclusive value="1"/>
        </xs:restriction>
      </xs:simpleType>
    </xs:attribute>
    <xs:attribute name="horizonheight" type="number">
      <xs:annotation>
        <xs:documentation>How high the horizon is above the base page of the open card.</xs:documentation>
      </xs:annotation>
    </xs:attribute>
  </xs:complexType>

  <xs:complexType name="text">
    <xs:annotation>
      <xs:documentation>A line of text with its middle at (x, y), its capitals so high.</xs:documentation>
    </xs:annotation>
    <xs:simpleContent>
      <xs:extension base="xs:string">
        <xs:attributeGroup ref="place"/>
        <xs:attribute name="height" type="size"/>
        <xs:attribute name="font" default="sans">
          <xs:simpleType>
            <xs:restriction base="xs:string">
{}            </xs:restriction>
          </xs:simpleType>
        </xs:attribute>
        <xs:attribute name="fill" type="color" default="#000000"/>
      </xs:extension>
    </xs:simpleContent>
  </xs:complexType>

  <xs:complexType name="area">
    <xs:attribute name="d" type="xs:string" use="required"/>
    <xs:attribute name="page" type="page" default="0"/>
    <xs:attribute name="fill" type="color" default="#000000"/>
  </xs:complexType>

  <xs:attributeGroup name="place">
    <xs:attribute name="page" type="page" default="0"/>
    <xs:attribute name="x" type="number" use="required"/>
    <xs:attribute name="y" type="number" use="required"/>
    <xs:attribute name="rotate" default="0">
      <xs:annotation>
        <xs:documentation>Degrees, counter-clockwise about (x, y).</xs:documentation>
      </xs:annotation>
      <xs:simpleType>
        <xs:restriction base="number">
          <xs:minInclusive value="-360"/>
          <xs:maxInclusive value="360"/>
        </xs:restriction>
      </xs:simpleType>
    </xs:attribute>
  </xs:attributeGroup>

  <xs:complexType name="mainpage">
    <xs:sequence>
      <xs:element name="leftcolor" type="color" minOccurs="0"/>
      <xs:element name="rightcolor" type="color" minOccurs="0"/>
    </xs:sequence>
    <xs:attribute name="width" type="size"/>
    <xs:attribute name="height" type="size"/>
    <xs:attribute name="opens" default="180">
      <xs:annotation>
        <xs:documentation>How far the card opens, in degrees. From version 3.0 on.</xs:documentation>
      </xs:annotation>
      <xs:simpleType>
        <xs:restriction base="number">
          <xs:minInclusive value="1"/>
          <xs:maxInclusive value="180"/>
        </xs:restriction>
      </xs:simpleType>
    </xs:attribute>
    <xs:attribute name="orientation">
      <xs:annotation>
        <xs:documentation>How models of it stand: upright, with the spine vertical; flat on a table; or as a stage, the right page on the ground. Guessed where nothing is given. From version 3.0 on.</xs:documentation>
      </xs:annotation>
      <xs:simpleType>
        <xs:restriction base="xs:token">
          <xs:enumeration value="upright"/>
          <xs:enumeration value="flat"/>
          <xs:enumeration value="stage"/>
        </xs:restriction>
      </xs:simpleType>
    </xs:attribute>
  </xs:complexType>

  <xs:complexType name="point">
    <xs:attribute name="x" type="number" use="required"/>
    <xs:attribute name="y" type="number" use="required"/>
  </xs:complexType>

  <xs:complexType name="pagepoint">
    <xs:complexContent>
      <xs:extension base="point">
        <xs:attribute name="page" type="page">
          <xs:annotation>
            <xs:documentation>Where the point does not lie on the page of the parent fold.</xs:documentation>
          </xs:annotation>
        </xs:attribute>
      </xs:extension>
    </xs:complexContent>
  </xs:complexType>

  <xs:simpleType name="number">
    <xs:annotation>
      <xs:documentation>Decimal, with an optional exponent; neither INF nor NaN.</xs:documentation>
    </xs:annotation>
    <xs:restriction base="xs:double">
      <xs:pattern value="[+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?"/>
    </xs:restriction>
  </xs:simpleType>

  <xs:simpleType name="size">
    <xs:restriction base="number">
      <xs:minExclusive value="0"/>
    </xs:restriction>
  </xs:simpleType>

  <xs:simpleType name="page">
    <xs:annotation>
      <xs:documentation>A number, or from version 3.0 on the id of the element whose piece it is; the base page is 0 or page.</xs:documentation>
    </xs:annotation>
    <xs:union memberTypes="id">
      <xs:simpleType>
        <xs:restriction base="xs:nonNegativeInteger">
          <xs:maxInclusive value="{}"/>
        </xs:restriction>
      </xs:simpleType>
    </xs:union>
  </xs:simpleType>

  <xs:simpleType name="color">
    <xs:restriction base="xs:string">
      <xs:pattern value="#[0-9a-fA-F]{{6}}"/>
    </xs:restriction>
  </xs:simpleType>

  <xs:simpleType name="id">
    <xs:restriction base="xs:string">
      <xs:pattern value="[A-Za-z_][A-Za-z0-9_.\-]*"/>
    </xs:restriction>
  </xs:simpleType>
)xsd";

// What a structure stands on, where it is a fold or seam.
constexpr std::string_view kParentFold =
    R"xsd(      <xs:element name="parentfold">
        <xs:annotation>
          <xs:documentation>Two points of the fold or seam. Left is the left-hand side, seen from begin to end.
            Or its name, such as gutter or bird.centre; points then lie beside it, x to its right and y along it from its
            middle. From version 3.0 on.</xs:documentation>
        </xs:annotation>
        <xs:complexType>
          <xs:sequence minOccurs="0">
            <xs:element name="begin" type="point"/>
            <xs:element name="end" type="point"/>
          </xs:sequence>
          <xs:attribute name="page" type="page"/>
          <xs:attribute name="on" type="xs:string"/>
        </xs:complexType>
      </xs:element>
)xsd";
constexpr std::string_view kParentPlate =
    R"xsd(      <xs:element name="parentplate">
        <xs:annotation>
          <xs:documentation>Any point of the plate; its page is 0 where it names none. Or its name, such as bird.left; points
            then lie beside the fold of that name, x to its right and y along it from its middle. From version 3.0 on.</xs:documentation>
        </xs:annotation>
        <xs:complexType>
          <xs:attribute name="x" type="number"/>
          <xs:attribute name="y" type="number"/>
          <xs:attribute name="page" type="page"/>
          <xs:attribute name="on" type="xs:string"/>
        </xs:complexType>
      </xs:element>
)xsd";

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&') {
            out += "&amp;";
        } else if (c == '<') {
            out += "&lt;";
        } else {
            out += c;
        }
    }
    return out;
}

// "A B (left), C (right); on the page of its piece: …": an element's points in order.
std::string points_of(const ElementInfo& info) {
    std::string text;
    PointPage page = PointPage::fold;
    for (const PointInfo& point : info.points) {
        if (point.page != page) text += ", on its own page:";
        page = point.page;
        const std::string_view side = point.side == 'L' ? " (left)" : point.side == 'R' ? " (right)" : "";
        text += fmt::format("{}{}{}", text.empty() ? "" : " ", point.letter, side);
    }
    return text;
}

// Both the name and the number that Popup Workshop wrote.
std::string types() {
    std::string out = "\n  <xs:simpleType name=\"type\">\n    <xs:restriction base=\"xs:string\">\n";
    for (const ElementInfo& info : element_table()) {
        out += fmt::format(
            "      <xs:enumeration value=\"{}\">\n        <xs:annotation>\n"
            "          <xs:documentation>{}. {} outer points: {}.</xs:documentation>\n"
            "        </xs:annotation>\n      </xs:enumeration>\n",
            info.name, escaped(info.about), info.points.size(), points_of(info));
    }
    for (const ElementInfo& info : element_table()) {
        if (info.code >= 0) out += fmt::format("      <xs:enumeration value=\"{}\"/>\n", info.code);
    }
    return out + "    </xs:restriction>\n  </xs:simpleType>\n";
}

// Each parameter of any row once that is `wanted`, each row's in its own order.
template <class Wanted>
std::vector<const ParameterInfo*> parameters(Wanted wanted) {
    std::vector<const ParameterInfo*> found;
    const auto at = [&found](const ParameterInfo& parameter) {
        return std::find_if(found.begin(), found.end(),
                            [&](const ParameterInfo* p) { return p->name == parameter.name; });
    };
    for (const ElementInfo& info : element_table()) {
        for (std::size_t i = 0; i < info.parameters.size(); ++i) {
            const ParameterInfo& parameter = info.parameters[i];
            if (!wanted(parameter.kind) || at(parameter) != found.end()) continue;
            // Before what comes after it in this row and is there from another.
            auto place = found.end();
            for (std::size_t k = i + 1; k < info.parameters.size(); ++k)
                place = std::min(place, at(info.parameters[k]));
            found.insert(place, &parameter);
        }
    }
    return found;
}

bool is_attribute(ParameterKind kind) {
    return kind == ParameterKind::length || kind == ParameterKind::number || kind == ParameterKind::choice;
}

// Of a choice of that name, in all rows that have one.
std::vector<std::string_view> words_of(std::string_view name) {
    std::vector<std::string_view> words;
    for (const ElementInfo& info : element_table()) {
        for (const ParameterInfo& parameter : info.parameters) {
            if (parameter.name != name) continue;
            for (const std::string_view word : parameter.words) {
                if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
            }
        }
    }
    return words;
}

std::string value_elements() {
    std::string out;
    for (const ParameterInfo* parameter :
         parameters([](ParameterKind kind) { return !is_attribute(kind); })) {
        const std::string_view type = parameter->kind == ParameterKind::colour ? "color"
                                      : parameter->kind == ParameterKind::path ? "path"
                                                                               : "points";
        out += fmt::format("      <xs:element name=\"{}\" type=\"{}\" minOccurs=\"0\"/>\n", parameter->name,
                           type);
    }
    return out;
}

std::string enumeration(std::span<const std::string_view> words, std::size_t indent) {
    std::string out;
    for (const std::string_view word : words)
        out += fmt::format("{}<xs:enumeration value=\"{}\"/>\n", std::string(indent, ' '), word);
    return out;
}

std::string value_attributes() {
    std::string out;
    for (const ParameterInfo* parameter : parameters(is_attribute)) {
        if (!parameter->group.empty()) continue;
        if (parameter->kind != ParameterKind::choice) {
            out += fmt::format("    <xs:attribute name=\"{}\" type=\"number\"/>\n", parameter->name);
            continue;
        }
        out += fmt::format(
            "    <xs:attribute name=\"{}\">\n      <xs:simpleType>\n        <xs:restriction "
            "base=\"xs:string\">\n",
            parameter->name);
        for (const std::string_view word : words_of(parameter->name))
            out += fmt::format("          <xs:enumeration value=\"{}\"/>\n", word);
        out += "        </xs:restriction>\n      </xs:simpleType>\n    </xs:attribute>\n";
    }
    return out;
}

// Child elements that hold several lengths.
std::string value_groups() {
    std::vector<std::string_view> names;
    for (const ParameterInfo* parameter : parameters(is_attribute)) {
        if (!parameter->group.empty() &&
            std::find(names.begin(), names.end(), parameter->group) == names.end())
            names.push_back(parameter->group);
    }
    std::string out;
    for (const std::string_view name : names) {
        out +=
            fmt::format("      <xs:element name=\"{}\" minOccurs=\"0\">\n        <xs:complexType>\n", name);
        for (const ParameterInfo* parameter : parameters(is_attribute)) {
            if (parameter->group == name)
                out +=
                    fmt::format("          <xs:attribute name=\"{}\" type=\"number\"/>\n", parameter->name);
        }
        out += "        </xs:complexType>\n      </xs:element>\n";
    }
    return out;
}

// parentfold, or parentplate too where a row stands on plates; neither where a row finds what it stands on.
std::string grounds() {
    const auto table = element_table();
    const bool may_find = std::any_of(table.begin(), table.end(), [](const ElementInfo& info) {
        return info.grounds.found || info.grounds.page;
    });
    const std::string_view least = may_find ? " minOccurs=\"0\"" : "";
    if (std::none_of(table.begin(), table.end(), [](const ElementInfo& info) { return info.grounds.plate; }))
        return std::string(kParentFold);
    return fmt::format("      <xs:choice{}>\n{}{}      </xs:choice>\n", least, kParentFold, kParentPlate);
}

// Types that only some rows need.
std::string value_types() {
    std::string out;
    if (!parameters([](ParameterKind kind) { return kind == ParameterKind::path; }).empty()) {
        out +=
            "\n  <xs:complexType name=\"path\">\n    <xs:annotation>\n"
            "      <xs:documentation>SVG path data, in the document's units, y up; or an SVG drawing whose "
            "closed lines are taken, placed as an image.</xs:documentation>\n"
            "    </xs:annotation>\n    <xs:attribute name=\"d\" type=\"xs:string\"/>\n"
            "    <xs:attribute name=\"href\" type=\"xs:string\"/>\n"
            "    <xs:attribute name=\"x\" type=\"number\"/>\n    <xs:attribute name=\"y\" type=\"number\"/>\n"
            "    <xs:attribute name=\"width\" type=\"number\"/>\n"
            "    <xs:attribute name=\"height\" type=\"number\"/>\n"
            "    <xs:attribute name=\"rotate\" type=\"number\"/>\n    <xs:attribute name=\"mirror\">\n"
            "      <xs:simpleType>\n        <xs:restriction base=\"xs:string\">\n"
            "          <xs:enumeration value=\"no\"/>\n          <xs:enumeration value=\"yes\"/>\n"
            "        </xs:restriction>\n      </xs:simpleType>\n    </xs:attribute>\n"
            "    <xs:attribute name=\"page\" type=\"page\"/>\n  </xs:complexType>\n";
    }
    if (!parameters([](ParameterKind kind) { return kind == ParameterKind::points; }).empty()) {
        out +=
            "\n  <xs:complexType name=\"points\">\n    <xs:sequence>\n"
            "      <xs:element name=\"point\" type=\"point\" minOccurs=\"0\" maxOccurs=\"unbounded\"/>\n"
            "    </xs:sequence>\n    <xs:attribute name=\"page\" type=\"page\"/>\n  </xs:complexType>\n";
    }
    return out;
}

std::string units() {
    std::string out = fmt::format(
        "      <xs:attribute name=\"units\" default=\"{}\">\n        <xs:simpleType>\n"
        "          <xs:restriction base=\"xs:string\">\n",
        unit_table().front().unit.name);
    for (const UnitRow& row : unit_table()) {
        out += fmt::format("            <xs:enumeration value=\"{}\"/>\n", row.unit.name);
    }
    return out +
           "          </xs:restriction>\n        </xs:simpleType>\n      </xs:attribute>\n"
           "    </xs:complexType>\n  </xs:element>\n";
}

}  // namespace

std::string render_schema() {
    const auto [fewest, most] = std::minmax_element(
        element_table().begin(), element_table().end(),
        [](const ElementInfo& a, const ElementInfo& b) { return a.points.size() < b.points.size(); });
    return std::string(kHead) + units() + types() +
           fmt::format(kStructure, fewest->points.empty() ? " minOccurs=\"0\"" : "",
                       std::max<std::size_t>(1, fewest->points.size()), most->points.size(),
                       value_groups() + value_elements(), grounds(), value_attributes(),
                       format_number(kThickestLine), enumeration(kPictureFitNames, 10),
                       enumeration(kTextFontNames, 14), kPageLimit) +
           value_types() + "</xs:schema>\n";
}

}  // namespace popup::xml
