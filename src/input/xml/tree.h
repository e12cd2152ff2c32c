// The document as tinyxml2 reads it, an element at a time, every part with its place in the source.
//
// A tree of the whole document would take ten times its bytes. So lists are walked in the located text, and
// only what is being read (one structure, one drawn line) is parsed into a tree.
#pragma once

#include <tinyxml2.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/xml/locate.h"
#include "popup/design.h"
#include "popup/diagnostics.h"

namespace popup::xml {

// A stretch of character data: decoded, and the bytes it stands in. Lives as long as its tree.
struct Text {
    std::string_view decoded;
    TextRange raw;
    Place place;             // of its first character that is not blank
    bool references = true;  // false for CDATA
    bool attribute = false;  // then `place` is that of the attribute's name
};

struct Attribute {
    std::string_view name;
    Text value;
    Place place;  // of the name
};

// An element of a tree. Lives as long as its tree.
class Node {
 public:
    Node() = default;
    [[nodiscard]] explicit operator bool() const { return dom_ != nullptr; }
    [[nodiscard]] std::string_view name() const { return dom_->Name(); }
    [[nodiscard]] Place place() const { return located().place; }
    [[nodiscard]] TextRange start_tag() const;
    [[nodiscard]] TextRange whole() const;
    [[nodiscard]] std::vector<Attribute> attributes() const;
    // The same, where it has nothing but attributes, and as many as that at the most; else none.
    template <std::size_t kMost>
    std::span<const Attribute> few_attributes(std::array<Attribute, kMost>& room) const {
        if (dom_->FirstChild() != nullptr) return {};
        std::size_t count = 0;
        for (const auto* a = dom_->FirstAttribute(); a != nullptr; a = a->Next()) {
            if (count == kMost) return {};
            room[count] = attribute(*a, count);
            ++count;
        }
        return {room.data(), count};
    }
    // Its own text, in the pieces that comments and child elements leave; those that are all blank are left
    // out.
    [[nodiscard]] std::vector<Text> texts() const;
    // All of its own text, as one: comments and child elements leave nothing.
    [[nodiscard]] std::string whole_text() const;
    [[nodiscard]] Node first_child() const { return {dom_->FirstChildElement(), source_}; }
    [[nodiscard]] Node next_sibling() const { return {dom_->NextSiblingElement(), source_}; }

 private:
    friend class Tree;
    Node(const tinyxml2::XMLElement* dom, const Located* source) : dom_(dom), source_(source) {}
    [[nodiscard]] const LocatedElement& located() const {
        return *static_cast<const LocatedElement*>(dom_->GetUserData());
    }
    // The n-th attribute, with its place.
    [[nodiscard]] Attribute attribute(const tinyxml2::XMLAttribute& dom, std::size_t n) const;
    const tinyxml2::XMLElement* dom_ = nullptr;
    const Located* source_ = nullptr;
};

class Tree {
 public:
    // How much of an element to parse.
    enum class Extent {
        whole,
        shell,  // its start tag and its own text; elements inside it are left out
        tag,    // its start tag alone
    };
    // Parses one element. `located` must outlive the tree. On failure an `xml-syntax` error, or
    // `document-too-large` for an element that alone has more than a million parts.
    static std::optional<Tree> parse(const Located& located, Offset element, Extent extent,
                                     Diagnostics& diagnostics);
    [[nodiscard]] Node root() const { return {dom_->RootElement(), located_}; }

 private:
    bool pair_with_places(Offset element, const std::vector<Offset>& own, bool shell);
    std::unique_ptr<tinyxml2::XMLDocument> dom_;
    const Located* located_ = nullptr;
};

}  // namespace popup::xml
