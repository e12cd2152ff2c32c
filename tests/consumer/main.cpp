// Compiles a document from memory with the installed library. Exit status 0 when everything is as it should
// be.
#include <popup/compile.h>
#include <popup/mechanism.h>

#include <cstdio>

int main() {
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
    for (const popup::Diagnostic& one : run.designs.front().diagnostics.sorted()) {
        std::printf("%s: %s [%s]\n", std::string(popup::to_string(one.severity)).c_str(), one.message.c_str(),
                    one.code.c_str());
    }
    if (run.has_findings() || !run.layout) return 1;
    const popup::Assembly& assembly = *run.designs.front().assembly;
    if (assembly.plates.size() != 4 || run.layout->sheets.size() != 1 || popup::element_table().size() < 9)
        return 1;
    const popup::Format* format = popup::find_format("svg");
    if (format == nullptr) return 1;
    const auto write = std::get<popup::SheetWriter>(format->write);
    const auto sheets = write(*run.layout, {}, run.run_diagnostics);
    if (!sheets || sheets->size() != 1 || sheets->front().bytes.find("<svg") == std::string::npos) return 1;
    std::printf("popup %s: %zu plates on %d sheet\n", std::string(popup::version()).c_str(),
                assembly.plates.size(), run.layout->sheets.size());
    return 0;
}
