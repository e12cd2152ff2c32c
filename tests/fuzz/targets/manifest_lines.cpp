// Manifests of batches in JSON lines.
#include "fuzz/targets/manifest.h"
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_manifest_lines(std::string_view bytes) { look_at_manifest(bytes, ManifestForm::json_lines); }

}  // namespace popup::fuzz
