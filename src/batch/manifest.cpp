#include "batch/manifest.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "base/text/fingerprint.h"
#include "base/text/nearest.h"
#include "base/text/quoted_words.h"
#include "base/text/utf8.h"

namespace popup {
namespace {

using nlohmann::json;

constexpr int kMostCopies = 10000;  // as --copies
constexpr std::array<std::string_view, 4> kFields{"input", "output", "options", "copies"};
constexpr std::size_t kInput = 0, kOutput = 1, kOptions = 2, kCopies = 3;  // their places in it

Diagnostic& wrong(Diagnostics& diagnostics, Place place, std::string message) {
    return diagnostics.error("bad-manifest", place, std::move(message));
}

void unknown_field(std::string_view name, std::string_view what, Place place, Diagnostics& diagnostics) {
    const std::vector<std::string_view> known(kFields.begin(), kFields.end());
    const std::vector<std::string> meant = nearest(name, known, 1);
    wrong(diagnostics, place, fmt::format("there is no {} \"{}\"", what, name))
        .hint(meant.empty() ? fmt::format("{}s: {}", what, fmt::join(known, ", "))
                            : fmt::format("did you mean \"{}\"?", meant.front()));
}

// Columns count characters.
int column_of(std::string_view line, std::size_t byte) {
    const std::string_view before = line.substr(0, byte);
    return 1 + static_cast<int>(std::count_if(before.begin(), before.end(), [](char c) {
               return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
           }));
}

// A name, or a list of names.
bool read_names(const json& value, std::vector<std::string>& names) {
    const auto add = [&names](const json& one) {
        if (!one.is_string()) return false;
        const std::string& name = one.get_ref<const std::string&>();
        if (name.empty() || name.find('\0') != std::string::npos) return false;
        names.push_back(one.get<std::string>());
        return true;
    };
    if (!value.is_array()) return add(value);
    return !value.empty() && std::all_of(value.begin(), value.end(), add);
}

bool read_options(const json& value, std::vector<std::string>& words) {
    if (value.is_string()) {
        Diagnostics trouble;
        for (QuotedWord& word : quoted_words(value.get_ref<const std::string&>(), "bad-manifest", trouble)) {
            words.push_back(std::move(word.text));
        }
        return !trouble.has_errors();
    }
    if (!value.is_array()) return false;
    for (const json& one : value) {
        if (!one.is_string()) return false;
        words.push_back(one.get<std::string>());
    }
    return true;
}

// The job of an object. Says what is wrong with it where somebody wants to know.
std::optional<BatchJob> job_of(const json& row, Place place, Diagnostics* diagnostics) {
    Diagnostics unheard;
    Diagnostics& told = diagnostics != nullptr ? *diagnostics : unheard;
    BatchJob job;
    bool good = true;
    const auto refuse = [&](std::string message) {
        wrong(told, place, std::move(message));
        good = false;
    };
    if (!row.is_object()) {
        refuse("a job is an object, such as {\"input\": \"card.xml\", \"output\": \"out/card.pdf\"}");
        return std::nullopt;
    }
    for (const auto& [key, value] : row.items()) {
        if (key == "input" || key == "output") {
            if (!read_names(value, key == "input" ? job.inputs : job.outputs)) {
                refuse(fmt::format("\"{}\" takes the name of a file or a list of names", key));
            }
        } else if (key == "options") {
            if (!read_options(value, job.options)) {
                refuse("\"options\" takes a list of words, or one string of words whose quotes are closed");
            }
        } else if (key == "copies") {
            const std::int64_t count = value.is_number_integer() ? value.get<std::int64_t>() : 0;
            if (count < 1 || count > kMostCopies) {
                refuse(fmt::format("\"copies\" takes a whole number from 1 to {}", kMostCopies));
            } else {
                job.copies = static_cast<int>(count);
            }
        } else {
            unknown_field(key, "key", place, told);
            good = false;
        }
    }
    if (good && job.inputs.empty()) refuse("the job has no \"input\"");
    if (good && job.outputs.empty()) refuse("the job has no \"output\"");
    if (!good) return std::nullopt;
    return job;
}

// A CSV parser that frees itself. RFC 4180, but for blanks round a field, which do not count.
class CsvParser {
 public:
    CsvParser() { csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI); }
    CsvParser(const CsvParser&) = delete;
    CsvParser& operator=(const CsvParser&) = delete;
    ~CsvParser() { csv_free(&parser_); }

    // False: quotes stand where they may not.
    bool feed(std::string_view text) {
        return csv_parse(&parser_, text.data(), text.size(), on_field, on_row, this) == text.size();
    }
    bool finish() { return csv_fini(&parser_, on_field, on_row, this) == 0; }
    // The fields of the row that has ended, and none of any further one.
    std::vector<std::string> fields;
    bool ended = false;
    bool further = false;  // a field stands behind its end: a carriage return alone ends a row, too

 private:
    static void on_field(void* data, std::size_t size, void* self) {
        auto& parser = *static_cast<CsvParser*>(self);
        parser.further = parser.further || parser.ended;
        if (!parser.ended) parser.fields.emplace_back(static_cast<const char*>(data), size);
    }
    static void on_row(int /*terminator*/, void* self) { static_cast<CsvParser*>(self)->ended = true; }
    csv_parser parser_{};
};

// A row of JSON. A key that stands in it twice is an error: only one of the two would be heard.
json parse_row(std::string_view row, Place place, Diagnostics& diagnostics) {
    std::set<std::string> keys;
    const auto hear = [&](int depth, json::parse_event_t event, json& value) {
        if (event != json::parse_event_t::key || depth != 1) return true;
        const auto& key = value.get_ref<const std::string&>();
        if (!keys.insert(key).second) {
            wrong(diagnostics, place, fmt::format("\"{}\" stands twice in the row", key))
                .hint("several names are a list: \"input\": [\"a.xml\", \"b.xml\"]");
        }
        return true;
    };
    return json::parse(row, hear);
}

// One text of a row as its fields.
std::vector<std::string> fields_of(std::string_view row) {
    CsvParser parser;
    parser.feed(row);
    parser.finish();
    return std::move(parser.fields);
}

// The object that a row of CSV stands for; what is no number stays text, for job_of() to refuse.
json object_of(const std::vector<std::string>& fields, const std::vector<std::size_t>& columns) {
    json object = json::object();
    for (std::size_t i = 0; i < std::min(fields.size(), columns.size()); ++i) {
        const std::string& field = fields[i];
        if (field.empty()) continue;
        json& value = object[std::string(kFields[columns[i]])];
        if (columns[i] == kCopies) {
            int count = 0;
            const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), count);
            const bool whole = error == std::errc() && stop == field.data() + field.size();
            value = whole ? json(count) : json(field);
        } else if (columns[i] == kOptions) {
            value = field;
        } else {
            value.push_back(field);
        }
    }
    return object;
}

bool is_utf8(const std::string& text) {
    try {
        static_cast<void>(json(text).dump());
    } catch (const json::type_error&) {
        return false;
    }
    return true;
}

// Names of files in the one spelling that all names of a file have. Relative ones count from a directory;
// none: the working directory. Directories are looked at once.
class FileNames {
 public:
    explicit FileNames(std::filesystem::path from = {}) : from_(std::move(from)) {}
    std::string whole(const std::string& name) {
        const std::filesystem::path path = std::filesystem::path(name).lexically_normal();
        const std::string folder = path.parent_path().string();
        const auto [at, fresh] = folders_.try_emplace(folder);
        if (fresh) {
            std::error_code error;
            // Absolute first: of a directory that is not there yet the name would stay relative.
            const std::filesystem::path real = std::filesystem::weakly_canonical(
                std::filesystem::absolute(from_ / path, error).parent_path(), error);
            at->second = error ? folder : real.string();
        }
        return at->second + '/' + path.filename().string();
    }
    std::uint64_t number(const std::string& name) { return fingerprint_number(whole(name)); }

 private:
    std::filesystem::path from_;
    std::unordered_map<std::string, std::string> folders_;
};

}  // namespace

std::uint64_t file_number(const std::string& name) { return fingerprint_number(FileNames().whole(name)); }

// Two jobs may not write one file, and none may read what another writes: jobs have no order.
void Manifest::check_names(const std::string& directory, Diagnostics& diagnostics) {
    uses_.reserve(2 * size());
    FileNames files(directory);
    for (std::size_t i = 0; i < size(); ++i) {
        const BatchJob one = job(i);
        for (const std::string& name : one.outputs) {
            uses_.push_back({files.number(name), static_cast<std::uint32_t>(i), true});
        }
        for (const std::string& name : one.inputs) {
            uses_.push_back({files.number(name), static_cast<std::uint32_t>(i), false});
        }
    }
    std::sort(uses_.begin(), uses_.end(),
              [](const Use& a, const Use& b) { return std::pair(a.file, a.job) < std::pair(b.file, b.job); });
    const auto named = [&files](const std::vector<std::string>& list, std::uint64_t file) {
        for (const std::string& name : list) {
            if (files.number(name) == file) return std::filesystem::path(name).lexically_normal().string();
        }
        return std::string();
    };
    for (std::size_t begin = 0, end = 0; begin < uses_.size(); begin = end) {
        const Use* writer = nullptr;
        for (end = begin; end < uses_.size() && uses_[end].file == uses_[begin].file; ++end) {
            if (uses_[end].written && writer == nullptr) writer = &uses_[end];
        }
        for (std::size_t i = begin; writer != nullptr && i < end; ++i) {
            const Use& other = uses_[i];
            if (&other == writer) continue;
            const BatchJob one = job(other.job);
            const std::string mine = named(other.written ? one.outputs : one.inputs, other.file);
            if (files.whole(mine) != files.whole(named(job(writer->job).outputs, other.file))) continue;
            if (other.job == writer->job) {
                wrong(diagnostics, place(other.job),
                      fmt::format("\"{}\" is {} of this job", mine,
                                  other.written ? "twice an output" : "an input and an output"));
            } else if (other.written) {
                wrong(diagnostics, place(other.job), fmt::format("\"{}\" is written by two jobs", mine))
                    .with(place(writer->job), "the other job");
            } else {
                wrong(diagnostics, place(other.job),
                      fmt::format("\"{}\" is written by another job of this batch", mine))
                    .with(place(writer->job), "the job that writes it")
                    .hint("jobs of a batch have no order; make two batches of it");
            }
        }
    }
    uses_.shrink_to_fit();
}

std::optional<std::size_t> Manifest::taken_by(const std::string& file, std::size_t index) const {
    const std::uint64_t number = file_number(file);
    const auto before = [](const Use& use, std::uint64_t wanted) { return use.file < wanted; };
    for (auto at = std::lower_bound(uses_.begin(), uses_.end(), number, before);
         at != uses_.end() && at->file == number; ++at) {
        if (at->job != index || !at->written) return at->job;
    }
    return std::nullopt;
}

std::string_view Manifest::text(std::size_t index) const {
    const Row& row = rows_[index];
    return std::string_view(source_.text).substr(row.begin, row.end - row.begin);
}

std::string_view Manifest::heading() const { return std::string_view(source_.text).substr(0, heading_end_); }

BatchJob Manifest::job(std::size_t index) const {
    const json row =
        form_ == ManifestForm::csv ? object_of(fields_of(text(index)), columns_) : json::parse(text(index));
    std::optional<BatchJob> job = job_of(row, place(index), nullptr);
    POPUP_INVARIANT(job.has_value());
    return std::move(*job);
}

// The first line of CSV.
bool Manifest::read_columns(const std::vector<std::string>& names, Place place, Diagnostics& diagnostics) {
    for (const std::string& name : names) {
        const auto at = std::find(kFields.begin(), kFields.end(), name);
        if (at == kFields.end()) {
            if (name.find(';') != std::string::npos) {
                wrong(diagnostics, place, "the columns are not separated by commas")
                    .hint("save it with commas, as RFC 4180 has it: input,output,options,copies");
                return false;
            }
            unknown_field(name, "column", place, diagnostics);
            continue;
        }
        columns_.push_back(static_cast<std::size_t>(at - kFields.begin()));
        if (columns_.back() >= kOptions &&
            std::count(columns_.begin(), columns_.end(), columns_.back()) > 1) {
            wrong(diagnostics, place, fmt::format("there are two columns \"{}\"", name));
        }
    }
    for (const std::size_t need : {kInput, kOutput}) {
        if (std::count(columns_.begin(), columns_.end(), need) > 0) continue;
        wrong(diagnostics, place, fmt::format("there is no column \"{}\"", kFields[need]))
            .hint("the first line names the columns: input,output,options,copies");
    }
    return !diagnostics.has_errors();
}

bool Manifest::read_json_lines(Diagnostics& diagnostics) {
    const std::string_view text = source_.text;
    std::uint32_t line = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view row = text.substr(begin, end - begin);
        ++line;
        if (row.find_first_not_of(" \t\r") != std::string_view::npos) {
            const Place place{static_cast<int>(line), 1};
            try {
                if (job_of(parse_row(row, place, diagnostics), place, &diagnostics)) {
                    rows_.push_back(
                        {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), line});
                }
            } catch (const json::out_of_range& /*a number that none can hold*/) {
                wrong(diagnostics, place, "the line has a number that is too large")
                    .hint("\"copies\" is a whole number from 1");
            } catch (const json::parse_error& error) {
                const std::size_t byte = error.byte > 0 ? error.byte - 1 : 0;
                wrong(diagnostics, {place.line, column_of(row, byte)}, "the line is not JSON")
                    .hint(
                        "each line is an object of its own: {\"input\": \"card.xml\", \"output\": "
                        "\"card.pdf\"}");
            }
        }
        begin = end + 1;
    }
    return !diagnostics.has_errors();
}

bool Manifest::read_csv(Diagnostics& diagnostics) {
    const std::string_view text = source_.text;
    std::uint32_t line = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        // A row goes on over line breaks that stand in quotes.
        CsvParser parser;
        const std::uint32_t first = line + 1;
        std::size_t end = begin;
        bool good = true;
        while (good && !parser.ended && end < text.size()) {
            const std::size_t next = std::min(text.find('\n', end), text.size() - 1) + 1;
            good = parser.feed(text.substr(end, next - end));
            end = next;
            ++line;
            // An empty line ends no row.
            if (good && !parser.ended && parser.fields.empty() &&
                text.substr(begin, end - begin).find_first_not_of(" \t\r\n") == std::string_view::npos) {
                break;
            }
        }
        if (good) good = parser.finish();
        const Place place{static_cast<int>(first), 1};
        std::size_t last = end;
        while (last > begin && (text[last - 1] == '\n' || text[last - 1] == '\r')) --last;
        if (!good) {
            wrong(diagnostics, place, "the row's quotes do not pair")
                .hint("a field with commas or quotes stands in quotes, and a quote in it is written twice");
        } else if (parser.further) {
            wrong(diagnostics, place, "the row has a carriage return in its middle")
                .hint("save the file with the line breaks of Unix or of Windows");
        } else if (!std::all_of(parser.fields.begin(), parser.fields.end(), is_utf8)) {
            wrong(diagnostics, place, "the row is not UTF-8");
        } else if (!parser.fields.empty() && columns_.empty()) {
            heading_end_ = static_cast<std::uint32_t>(end);
            if (!read_columns(parser.fields, place, diagnostics)) return false;
        } else if (parser.fields.size() > columns_.size()) {
            wrong(diagnostics, place,
                  fmt::format("the row has {} fields, and there are {} columns", parser.fields.size(),
                              columns_.size()));
        } else if (!parser.fields.empty() &&
                   job_of(object_of(parser.fields, columns_), place, &diagnostics)) {
            rows_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(last), first});
        }
        // Without columns nothing can be said of the rows.
        if (columns_.empty() && diagnostics.has_errors()) return false;
        begin = end;
    }
    return !diagnostics.has_errors();
}

std::optional<Manifest> read_manifest(Source source, std::optional<ManifestForm> form,
                                      Diagnostics& diagnostics, const std::string& directory) {
    Manifest manifest;
    manifest.form_ =
        form.value_or(source.name.ends_with(".csv") ? ManifestForm::csv : ManifestForm::json_lines);
    manifest.source_ = std::move(source);
    manifest.source_.text.erase(0, manifest.source_.text.size() - without_mark(manifest.source_.text).size());
    const bool read = manifest.form_ == ManifestForm::csv ? manifest.read_csv(diagnostics)
                                                          : manifest.read_json_lines(diagnostics);
    if (!read) return std::nullopt;
    if (manifest.rows_.empty()) {
        wrong(diagnostics, {}, "the manifest has no job");
        return std::nullopt;
    }
    manifest.rows_.shrink_to_fit();
    manifest.check_names(directory, diagnostics);
    if (diagnostics.has_errors()) return std::nullopt;
    return manifest;
}

}  // namespace popup
