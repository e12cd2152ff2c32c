// Manifests of batches in CSV.
#include "fuzz/targets/manifest.h"
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_manifest_csv(std::string_view bytes) { look_at_manifest(bytes, ManifestForm::csv); }

}  // namespace popup::fuzz
