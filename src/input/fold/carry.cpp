#include "input/fold/carry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace popup::fold {
namespace {

// Whoever writes the file says these of what is written.
constexpr auto kSaidAnew = std::to_array<std::string_view>(
    {"file_spec",      "file_creator",    "file_frames",       "frame_unit",      "frame_parent",
     "frame_inherit",  "vertices_coords", "vertices_vertices", "vertices_edges",  "vertices_faces",
     "edges_vertices", "edges_faces",     "edges_assignment",  "edges_foldAngle", "edges_foldAngles",
     "edges_length",   "edges_lengths",   "faces_vertices",    "faces_edges",     "faces_faces"});

template <std::size_t N>
bool is_one_of(std::string_view key, const std::array<std::string_view, N>& keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

bool is_own(std::string_view key) { return key.find("popupc:") != std::string_view::npos; }

class Carrier {
 public:
    Carrier(std::string_view text, const ElementCounts& counts) : text_(text), counts_(counts) {}

    void take(const JsonMember& member) {
        const std::string& key = member.name;
        if (member.value.null() || is_one_of(key, kSaidAnew) || is_own(key) || !taken_.insert(key).second)
            return;
        if (key.starts_with("vertices_")) {
            take_column(member, counts_.vertices, out_.vertices);
        } else if (key.starts_with("edges_")) {
            take_column(member, counts_.edges, out_.edges);
        } else if (key.starts_with("faces_")) {
            take_column(member, counts_.faces, out_.faces);
        } else if (key == "edgeOrders" || (key == "faceOrders" && !are_orders(member.value))) {
            out_.left_out.push_back(key);
        } else {
            out_.members.push_back({key, compact_value(text_, member.value.at)});
        }
    }

    CarriedKeys done() { return std::move(out_); }

 private:
    // Triples of two faces and the side of the second on which the first lies: -1, 0 or 1.
    [[nodiscard]] bool are_orders(const JsonValue& value) const {
        const JsonList* orders = value.list();
        if (orders == nullptr) return false;
        return std::all_of(orders->begin(), orders->end(), [&](const JsonValue& order) {
            const JsonList* three = order.list();
            if (three == nullptr || three->size() != 3) return false;
            const auto is_between = [three](std::size_t i, double least, double most) {
                const double* number = (*three)[i].number();
                return number != nullptr && *number >= least && *number <= most &&
                       *number == std::floor(*number);
            };
            const double last = static_cast<double>(counts_.faces) - 1.0;
            return is_between(0, 0.0, last) && is_between(1, 0.0, last) && is_between(2, -1.0, 1.0);
        });
    }

    void take_column(const JsonMember& member, std::size_t count, std::vector<CarriedKeys::Column>& columns) {
        const JsonList* values = member.value.list();
        if (values == nullptr || values->size() != count || count == 0) {
            out_.left_out.push_back(member.name);
            return;
        }
        CarriedKeys::Column column{member.name, {}};
        column.json.reserve(count);
        for (const JsonValue& value : *values) column.json.push_back(compact_value(text_, value.at));
        columns.push_back(std::move(column));
    }

    std::string_view text_;
    const ElementCounts& counts_;
    std::set<std::string> taken_;
    CarriedKeys out_;
};

}  // namespace

std::string compact_value(std::string_view text, std::size_t at) {
    std::string value;
    std::size_t depth = 0;
    bool in_text = false;
    for (; at < text.size(); ++at) {
        const char c = text[at];
        if (in_text) {
            value += c;
            if (c == '\\' && at + 1 < text.size()) value += text[++at];
            in_text = c != '"';
            if (!in_text && depth == 0) break;
            continue;
        }
        const bool closes = c == ']' || c == '}';
        // What follows a number or a word on the outermost level is not its own.
        if (depth == 0 && !value.empty() && (closes || c == ',')) break;
        if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
            if (depth == 0 && !value.empty()) break;
            continue;
        }
        value += c;
        in_text = c == '"';
        if (c == '[' || c == '{') ++depth;
        if (closes && --depth == 0) break;
    }
    return value;
}

CarriedKeys carry(std::string_view text, const JsonValue& file, std::span<const JsonValue* const> frames,
                  const ElementCounts& counts) {
    Carrier carrier(text, counts);
    for (const JsonMember& member : *file.object()) {
        if (member.name.starts_with("file_")) carrier.take(member);
    }
    for (const JsonValue* frame : frames) {
        for (const JsonMember& member : *frame->object()) carrier.take(member);
    }
    return carrier.done();
}

}  // namespace popup::fold
