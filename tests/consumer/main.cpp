// Uses the installed library: compiles a document from memory, then one from a file, of which it writes all
// files as popupc does. Exit status 0 when everything is as it should be.
//
// consumer DOCUMENT DIRECTORY
#include <popup/compile.h>
#include <popup/mechanism.h>
#include <popup/write.h>

#include <cstdio>
#include <string>

namespace {

void tell(const popup::Diagnostics& diagnostics) {
    for (const popup::Diagnostic& one : diagnostics.sorted()) {
        std::printf("%s: %s [%s]\n", std::string(popup::to_string(one.severity)).c_str(), one.message.c_str(),
                    one.code.c_str());
    }
}

// One value from a stage to the next, and one writer called by hand.
bool compiles_from_memory() {
    const popup::Source source{
        "card.xml",
        "<popup version=\"2.0\" units=\"mm\">\n"
        "  <mainpage width=\"200\" height=\"150\"/>\n"
        "  <structurelist>\n"
        "    <structure type=\"step\">\n"
        "      <outerpoints>\n"
        "        <point x=\"-30\" y=\"20\"/><point x=\"-30\" y=\"-20\"/>\n"
        "        <point x=\"20\" y=\"20\"/><point x=\"20\" y=\"-20\"/>\n"
        "      </outerpoints>\n"
        "      <parentfold page=\"0\"><begin x=\"0\" y=\"-75\"/><end x=\"0\" y=\"75\"/></parentfold>\n"
        "    </structure>\n"
        "  </structurelist>\n"
        "</popup>\n"};
    const popup::CompileOptions options;
    popup::Compilation run = popup::compile({source}, options, {});
    tell(run.designs.front().diagnostics);
    if (run.has_findings() || !run.layout) return false;
    const popup::Assembly& assembly = *run.designs.front().assembly;
    if (assembly.plates.size() != 4 || run.layout->sheets.size() != 1 || popup::element_table().size() < 9)
        return false;
    const popup::Format* format = popup::find_format("svg");
    if (format == nullptr) return false;
    const auto write = std::get<popup::SheetWriter>(format->write);
    const auto sheets = write(*run.layout, {}, run.run_diagnostics);
    if (!sheets || sheets->size() != 1 || sheets->front().bytes.find("<svg") == std::string::npos)
        return false;
    std::printf("popup %s: %zu plates on %zu sheet\n", std::string(popup::version()).c_str(),
                assembly.plates.size(), run.layout->sheets.size());
    return true;
}

// What `popupc build DOCUMENT --copies 4 --sheet a3 --profile k40 --reference 100 -o …` writes.
bool writes_all_files(const std::string& document, const std::string& directory) {
    popup::Diagnostics told;
    const std::string stem = directory + "/card";
    popup::OutputRequest request;
    request.outputs = {stem + ".svg", stem + ".pdf", stem + ".glb", stem + ".json"};
    request.inputs = {document};
    const auto plan = popup::plan_outputs(request, told);
    const auto source = popup::read_source(document, told);
    tell(told);
    if (!plan || !source) return false;

    popup::CompileOptions options;
    options.layout.sheet = *popup::parse_sheet("a3");
    options.layout.copies = 4;
    options.output.profile = *popup::find_profile("k40");
    options.output.reference_mm = 100.0;
    popup::fit_layout(options);
    popup::Compilation run = popup::compile({*source}, options, {});
    const auto written = popup::write_files(*plan, options.output, run);
    tell(run.designs.front().diagnostics);
    tell(run.run_diagnostics);
    if (!written || !run.layout || written->size() != 3 + run.layout->sheets.size()) return false;
    for (const std::string& name : *written) std::printf("wrote %s\n", name.c_str());
    return true;
}

// A plan that would lose something is refused, and nothing is written.
bool keeps_inputs(const std::string& document) {
    popup::Diagnostics told;
    popup::OutputRequest request;
    request.outputs = {document};
    request.inputs = {document};
    return !popup::plan_outputs(request, told) && popup::output_refused(told);
}

}  // namespace

int main(int count, char** words) {
    if (count != 3) return 2;
    const bool good =
        compiles_from_memory() && writes_all_files(words[1], words[2]) && keeps_inputs(words[1]);
    return good ? 0 : 1;
}
