#include "input/xml/tree.h"

#include <fmt/format.h>

#include <algorithm>

#include "input/text.h"

namespace popup::xml {
namespace {

constexpr std::size_t kPartsLimit = 1'000'000;

TextRange range(std::size_t begin, std::size_t end) { return {begin, end - begin}; }

// Copies [begin, end) of the source. Processing instructions become comments: tinyxml2 takes them only at the
// start of a document, and a comment parts the text around it just as they do.
void append_source(std::string& out, const Located& located, std::size_t begin, std::size_t end) {
    auto instruction =
        std::lower_bound(located.instructions.begin(), located.instructions.end(), begin,
                         [](const Instruction& a, std::size_t offset) { return a.begin < offset; });
    for (; instruction != located.instructions.end() && instruction->end <= end; ++instruction) {
        out += located.text.substr(begin, instruction->begin - begin);
        out += "<!---->";
        begin = instruction->end;
    }
    out += located.text.substr(begin, end - begin);
}

// The texts directly in the element, not in elements inside it.
std::vector<Offset> own_texts(const Located& located, Offset index) {
    const LocatedElement& element = located.elements[index];
    std::vector<Offset> out;
    Offset child = index + 1;
    for (Offset i = element.first_text; i < located.texts.size() && located.texts[i].begin < element.end;
         ++i) {
        while (child < element.after && located.elements[child].end <= located.texts[i].begin) {
            child = located.elements[child].after;
        }
        const bool inside = child < element.after && located.elements[child].begin < located.texts[i].begin;
        if (!inside) out.push_back(i);
    }
    return out;
}

// The element's start tag and these of its texts; nothing else of what it holds.
std::string shell_of(const Located& located, Offset index, const std::vector<Offset>& texts) {
    const LocatedElement& element = located.elements[index];
    std::string out(located.text.substr(element.begin, element.tag_end - element.begin));
    if (element.end == element.tag_end) return out;
    for (const Offset i : texts) {
        const LocatedText& text = located.texts[i];
        const std::string_view raw = located.text.substr(text.begin, text.end - text.begin);
        // Comments keep the texts apart.
        out += text.cdata ? "<![CDATA[" : "<!---->";
        out += raw;
        if (text.cdata) out += "]]>";
    }
    out += "</";
    out += located.name(index);
    return out + ">";
}

Offset end_of(const std::vector<LocatedElement>& elements, Offset index, Offset LocatedElement::*member,
              std::size_t total) {
    return index < elements.size() ? elements[index].*member : static_cast<Offset>(total);
}

// How many nodes and attributes the tree of the whole element will have.
std::size_t parts_of(const Located& located, Offset index) {
    const LocatedElement& first = located.elements[index];
    const auto count = [&](Offset LocatedElement::*member, std::size_t total) {
        return std::size_t{end_of(located.elements, first.after, member, total)} - first.*member;
    };
    return first.after - index + count(&LocatedElement::first_attribute, located.attributes.size()) +
           count(&LocatedElement::first_text, located.texts.size()) +
           count(&LocatedElement::asides_before, located.asides);
}

}  // namespace

TextRange Node::start_tag() const { return range(located().begin, located().tag_end); }
TextRange Node::whole() const { return range(located().begin, located().end); }

Attribute Node::attribute(const tinyxml2::XMLAttribute& dom, std::size_t n) const {
    const LocatedAttribute& place = source_->attributes[located().first_attribute + n];
    const TextRange raw = range(place.value, place.value + place.value_length);
    return {dom.Name(), {dom.Value(), raw, place.place, true, true}, place.place};
}

std::vector<Attribute> Node::attributes() const {
    std::vector<Attribute> out;
    for (const auto* a = dom_->FirstAttribute(); a; a = a->Next()) out.push_back(attribute(*a, out.size()));
    return out;
}

std::vector<Text> Node::texts() const {
    std::vector<Text> out;
    for (const auto* child = dom_->FirstChild(); child; child = child->NextSibling()) {
        if (!child->ToText() || trimmed(child->Value()).empty()) continue;
        const auto& place = *static_cast<const LocatedText*>(child->GetUserData());
        out.push_back({child->Value(), range(place.begin, place.end), place.place, !place.cdata, false});
    }
    return out;
}

std::string Node::whole_text() const {
    std::string out;
    for (const auto* child = dom_->FirstChild(); child; child = child->NextSibling()) {
        if (child->ToText()) out += child->Value();
    }
    return out;
}

std::optional<Tree> Tree::parse(const Located& located, Offset element, Extent extent,
                                Diagnostics& diagnostics) {
    const LocatedElement& root = located.elements[element];
    const bool shell = extent != Extent::whole;
    const std::vector<Offset> own =
        extent == Extent::shell ? own_texts(located, element) : std::vector<Offset>{};
    const std::size_t parts = shell ? own.size() : parts_of(located, element);
    if (parts > kPartsLimit) {
        diagnostics.error("document-too-large", root.place,
                          fmt::format("this element has {} parts, more than {}", parts, kPartsLimit));
        return std::nullopt;
    }

    Tree tree;
    tree.located_ = &located;
    tree.dom_ = std::make_unique<tinyxml2::XMLDocument>();
    if (!shell && located.instructions.empty()) {
        tree.dom_->Parse(located.text.data() + root.begin, root.end - root.begin);
    } else {
        std::string text;
        if (shell) {
            text = shell_of(located, element, own);
        } else {
            append_source(text, located, root.begin, root.end);
        }
        tree.dom_->Parse(text.data(), text.size());
    }
    if (tree.dom_->Error()) {
        const Place place{root.place.line + std::max(tree.dom_->ErrorLineNum() - 1, 0), 1};
        diagnostics.error("xml-syntax", place,
                          fmt::format("this is not well-formed XML ({})", tree.dom_->ErrorName()));
        return std::nullopt;
    }
    if (!tree.pair_with_places(element, own, shell)) {
        diagnostics.error("xml-syntax", root.place, "this element is not well-formed XML");
        return std::nullopt;
    }
    return tree;
}

// Walks the tree and the located text side by side. False when they differ, which well-formed XML never does:
// then tinyxml2 has understood something else than the places say, and nothing may be made of it.
bool Tree::pair_with_places(Offset element, const std::vector<Offset>& own, bool shell) {
    const auto& elements = located_->elements;
    const auto& texts = located_->texts;
    const Offset first_text = elements[element].first_text;
    const std::size_t text_count = shell ? own.size() : texts.size() - first_text;
    std::size_t next_text = 0;
    Offset next = element;
    tinyxml2::XMLNode* node = dom_->RootElement();
    const tinyxml2::XMLNode* const root = node;
    while (node) {
        if (auto* found = node->ToElement()) {
            if (next >= elements[element].after || located_->name(next) != found->Name()) return false;
            const LocatedElement& place = elements[next];
            const Offset stop =
                end_of(elements, next + 1, &LocatedElement::first_attribute, located_->attributes.size());
            Offset attribute = place.first_attribute;
            for (const auto* a = found->FirstAttribute(); a; a = a->Next()) {
                if (attribute >= stop) return false;
                ++attribute;
            }
            if (attribute != stop) return false;
            // tinyxml2 has user data that may be written; it is only ever read.
            found->SetUserData(const_cast<LocatedElement*>(&place));
            ++next;
        } else if (node->ToText()) {
            if (next_text == text_count) return false;
            const LocatedText& place = texts[shell ? own[next_text] : first_text + next_text];
            node->SetUserData(const_cast<LocatedText*>(&place));
            ++next_text;
        }
        // Document order without recursion.
        if (node->FirstChild()) {
            node = node->FirstChild();
            continue;
        }
        while (node != root && !node->NextSibling()) node = node->Parent();
        node = node == root ? nullptr : node->NextSibling();
    }
    return shell || next == elements[element].after;
}

}  // namespace popup::xml
