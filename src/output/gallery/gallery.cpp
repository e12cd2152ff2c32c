#include "output/gallery/gallery.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "base/text/base64.h"
#include "base/text/numbers.h"
#include "base/text/utf8.h"
#include "output/gallery/page_files.h"
#include "output/html_page.h"
#include "output/markup.h"
#include "output/raster.h"
#include "output/svg.h"
#include "output/viewer/sections.h"

namespace popup {
namespace {

constexpr int kDecimals = 1;
constexpr std::size_t kLongestMessage = 160;  // characters of an error that a tile has
constexpr double kInch = 25.4;

// The text, or what of it is not longer than `most` characters.
std::string cut(std::string_view text, std::size_t most) {
    std::size_t bytes = 0;
    for (std::size_t count = 0; bytes < text.size(); ++count) {
        if (count == most) return std::string(text.substr(0, bytes)) + " …";
        bytes += first_character(text.substr(bytes)).bytes;
    }
    return std::string(text);
}

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::size_t count_of(const GalleryTile& tile, Severity severity) {
    std::size_t count = 0;
    for (const FindingCount& one : tile.findings) {
        if (one.severity == severity) count += one.count;
    }
    return count;
}

// "2 errors, 1 warning"; remarks only where there is nothing worse.
std::string findings_text(const GalleryTile& tile) {
    std::string text;
    for (const Severity severity : {Severity::error, Severity::warning, Severity::remark}) {
        const std::size_t count = count_of(tile, severity);
        if (count == 0 || (severity == Severity::remark && !text.empty())) continue;
        text += (text.empty() ? "" : ", ") + counted(count, to_string(severity));
    }
    return text;
}

std::string elements_text(const GalleryTile& tile) {
    std::string text;
    for (const auto& [name, count] : tile.elements) {
        text += text.empty() ? "" : ", ";
        text += count == 1 ? name : fmt::format("{}\u00a0×\u00a0{}", count, name);
    }
    return text;
}

std::string kept_together(std::string text) {
    const std::size_t blank = text.find(' ');
    if (blank != std::string::npos) text.replace(blank, 1, "\u00a0");
    return text;
}

// "200 × 140 mm, 2 pieces, 1 sheet", which breaks behind commas only.
std::string facts_text(const GalleryTile& tile) {
    std::string text;
    if (tile.width_mm > 0.0) {
        text += fmt::format("{}\u00a0×\u00a0{}\u00a0mm", number_text(tile.width_mm, kDecimals),
                            number_text(tile.height_mm, kDecimals));
    }
    if (tile.pieces > 0) text += (text.empty() ? "" : ", ") + kept_together(counted(tile.pieces, "piece"));
    if (tile.sheets > 0) text += (text.empty() ? "" : ", ") + kept_together(counted(tile.sheets, "sheet"));
    return text;
}

std::string line_of(std::string_view kind, const std::string& text) {
    if (text.empty()) return {};
    return fmt::format("<p class=\"{}\">{}</p>", kind, told_html(text));
}

std::string words_of(std::string_view name, const std::vector<std::string>& words) {
    if (words.empty()) return {};
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + told_html(word);
    return fmt::format(" data-{}=\"{}\"", name, text);
}

std::string picture_html(const GalleryTile& tile) {
    if (!tile.picture.empty()) {
        return fmt::format(
            "<img src=\"{}\" alt=\"\" width=\"{}\" height=\"{}\" loading=\"lazy\" decoding=\"async\">",
            tile.picture, kTileSize.width, kTileSize.height);
    }
    std::string html = "<div class=\"told\">";
    for (const std::string& message : tile.errors) {
        html += fmt::format("<p>{}</p>", told_html(cut(message, kLongestMessage)));
    }
    const std::size_t errors = count_of(tile, Severity::error);
    if (errors > tile.errors.size()) html += fmt::format("<p>and {} more</p>", errors - tile.errors.size());
    return html + "</div>";
}

std::string tile_html(const GalleryTile& tile) {
    std::vector<std::string> elements;
    for (const auto& [name, count] : tile.elements) elements.push_back(name);
    std::vector<std::string> codes;
    for (const FindingCount& one : tile.findings) codes.push_back(one.code);
    const bool failed = count_of(tile, Severity::error) > 0;
    std::string html = "<li" + words_of("elements", elements) + words_of("codes", codes);
    if (!tile.findings.empty())
        html += fmt::format(" data-worst=\"{}\"", to_string(tile.findings.front().severity));
    if (tile.width_mm > 0.0) {
        html +=
            fmt::format(" data-side=\"{}\"", number_text(std::max(tile.width_mm, tile.height_mm), kDecimals));
    }
    if (tile.pieces > 0) html += fmt::format(" data-pieces=\"{}\"", tile.pieces);
    html += fmt::format(">{}<h2><a href=\"{}\">{}</a></h2>", picture_html(tile), tile.page,
                        told_html(tile.title));
    html += line_of("file", tile.file) + line_of("elements", elements_text(tile)) +
            line_of("facts", facts_text(tile));
    const bool remarks = !failed && count_of(tile, Severity::warning) == 0;
    html += line_of(remarks ? "remarks" : "findings", findings_text(tile));
    return html + "</li>\n";
}

// An <option> for each word that designs have, and how many of them do.
std::string choices(const std::map<std::string, std::size_t>& counts) {
    std::string html;
    for (const auto& [word, count] : counts) {
        html += fmt::format("<option value=\"{0}\">{0} ({1})</option>", told_html(word), count);
    }
    return html;
}

std::string style() {
    std::string text = "\n";
    append_page_lines(text, page_file(gallery_files(), "gallery.css"));
    return text;
}

std::string script() {
    std::string text = "\n(() => {\n'use strict';\n";
    append_page_lines(text, page_file(gallery_files(), "gallery.js"));
    return text + "})();\n";
}

// "24 designs, 1 of them with errors"
std::string summary_of(std::span<const GalleryTile> tiles) {
    const auto failed = std::count_if(tiles.begin(), tiles.end(), [](const GalleryTile& one) {
        return count_of(one, Severity::error) > 0;
    });
    std::string text = counted(tiles.size(), "design");
    if (failed > 0) text += fmt::format(", {} of them with errors", failed);
    return text;
}

std::optional<std::string> sheets_html(const Layout& layout, const OutputOptions& options,
                                       Diagnostics& diagnostics) {
    OutputOptions whole = options;
    whole.print_and_cut = false;
    const auto files = write_svg(layout, whole, diagnostics);
    if (!files) return std::nullopt;
    std::string html;
    for (std::size_t i = 0; i < files->size(); ++i) {
        html += fmt::format(
            "<figure><img alt=\"Drawing {0} of {1} of the sheets\" "
            "src=\"data:image/svg+xml;base64,{2}\"></figure>\n",
            i + 1, files->size(), base64((*files)[i].bytes));
    }
    return html;
}

}  // namespace

void tell_findings(std::span<const Diagnostic> findings, GalleryTile& tile) {
    std::map<std::pair<int, std::string>, FindingCount> counts;
    for (const Diagnostic& one : findings) {
        FindingCount& row = counts[{-static_cast<int>(one.severity), one.code}];
        row = {one.code, one.severity, row.count + 1};
        if (one.severity == Severity::error && tile.errors.size() < kTileErrors)
            tile.errors.push_back(one.message);
    }
    for (auto& [key, row] : counts) tile.findings.push_back(std::move(row));
}

std::string write_gallery(const std::string& title, std::span<const GalleryTile> tiles) {
    std::string list;
    std::map<std::string, std::size_t> elements;
    std::map<std::string, std::size_t> codes;
    for (const GalleryTile& tile : tiles) {
        list += tile_html(tile);
        for (const auto& [name, count] : tile.elements) ++elements[name];
        // A code may be there with two severities: of findings, and of how many more there are.
        std::set<std::string_view> found;
        for (const FindingCount& one : tile.findings) found.insert(one.code);
        for (const std::string_view one : found) ++codes[std::string(one)];
    }
    const std::string look = style();
    const std::string code = script();
    const std::string policy = fmt::format(
        "default-src 'none'; script-src {}; style-src {}; img-src 'self' file: data:; base-uri 'none'; "
        "form-action 'none'",
        policy_source(code), policy_source(look));
    const std::array<std::pair<std::string_view, std::string>, 7> values{{
        {"head", page_head(policy, told_html(title), look)},
        {"title", told_html(title)},
        {"summary", summary_of(tiles)},
        {"elements", choices(elements)},
        {"codes", choices(codes)},
        {"tiles", std::move(list)},
        {"script", code},
    }};
    return filled_page(page_file(gallery_files(), "gallery.html"), values);
}

std::optional<std::string> write_plain_page(const GalleryTile& tile, const std::string& gallery,
                                            const Layout* layout, std::span<const Diagnostic> findings,
                                            const OutputOptions& options, Diagnostics& diagnostics) {
    std::string body;
    if (layout != nullptr) {
        const auto sheets = sheets_html(*layout, options, diagnostics);
        if (!sheets) return std::nullopt;
        body += "<h2>Sheets</h2>\n" + *sheets;
    }
    body += "<h2>Findings</h2>\n" + viewer_findings(findings);
    std::string facts = line_of("file", tile.file) + line_of("facts", facts_text(tile));
    const std::string look = style();
    const std::string policy =
        fmt::format("default-src 'none'; style-src {}; img-src data:; base-uri 'none'; form-action 'none'",
                    policy_source(look));
    const std::array<std::pair<std::string_view, std::string>, 5> values{{
        {"head", page_head(policy, told_html(tile.title), look)},
        {"title", told_html(tile.title)},
        {"gallery", gallery},
        {"facts", std::move(facts)},
        {"body", std::move(body)},
    }};
    return filled_page(page_file(gallery_files(), "plain.html"), values);
}

std::optional<std::string> sheet_picture(const Layout& layout, const OutputOptions& options,
                                         Diagnostics& diagnostics) {
    POPUP_INVARIANT(!layout.sheets.empty());
    // What a sheet of its own shows is the first sheet: the others are not drawn.
    Layout first = layout;
    first.sheets.resize(1);
    first.placements.erase(std::remove_if(first.placements.begin(), first.placements.end(),
                                          [](const Placement& one) { return one.sheet > 0; }),
                           first.placements.end());
    // Pieces lie in its lower left corner; marks and bar are not for looking at.
    LayoutSheet& sheet = first.sheets.front();
    sheet.width_mm = std::min(sheet.width_mm, sheet.used_mm.x + 2.0 * first.margin_mm);
    sheet.height_mm = std::min(sheet.height_mm, sheet.used_mm.y + 2.0 * first.margin_mm);
    OutputOptions small = options;
    small.backs = false;
    small.print_and_cut = false;
    small.reference_mm = 0.0;
    small.profile.marks = Marks::none;
    small.dpi = kInch * std::min(kTileSize.width / sheet.width_mm, kTileSize.height / sheet.height_mm);
    auto files = write_png(first, small, diagnostics);
    if (!files) return std::nullopt;
    return std::move(files->front().bytes);
}

}  // namespace popup
