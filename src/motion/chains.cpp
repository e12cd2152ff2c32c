#include "motion/chains.h"

#include <cstring>
#include <utility>

namespace popup {
namespace {

// The values of a joint as bytes. Plates that it places are known by their place among these, others by their
// chains.
class JointBytes {
 public:
    JointBytes(const std::vector<PlacedPlate>& own, const std::vector<int>& chains)
        : own_(own), chains_(chains) {}

    void plate(const char* /*name*/, int number) {
        for (std::size_t i = 0; i < own_.size(); ++i) {
            if (own_[i].plate == number) return raw(-2 - static_cast<int>(i));
        }
        raw(number < 0 ? -1 : chains_[static_cast<std::size_t>(number)]);
    }
    void point(const char* /*name*/, Vec2 p) { value(p); }
    void direction(const char* /*name*/, Vec2 p) { value(p); }
    void length(const char* /*name*/, double mm) { raw(mm); }
    void angle(const char* /*name*/, double rad) { raw(rad); }
    void sign(const char* /*name*/, int sign) { raw(sign); }
    void flag(const char* /*name*/, bool flag) { raw(flag); }
    void flag_if_set(const char* /*name*/, bool flag) { raw(flag); }
    template <typename Word, typename Names>
    void word(const char* /*name*/, Word word, const Names& /*names*/) {
        raw(static_cast<int>(word));
    }
    template <typename Inside>
    void object(const char* /*name*/, const Inside& inside) {
        inside(*this);
    }
    void value(const char* /*name*/, const std::vector<Vec2>& points) {
        raw(points.size());
        for (const Vec2 p : points) value(p);
    }

    template <typename Number>
    void raw(Number number) {
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }

    std::string bytes;

 private:
    void value(Vec2 p) {
        raw(p.x);
        raw(p.y);
    }

    const std::vector<PlacedPlate>& own_;
    const std::vector<int>& chains_;
};

}  // namespace

int Chains::number_of(std::string&& values) {
    // Equal ones are told apart by which of them they are.
    for (int which = 0;; ++which) {
        std::string key = values;
        key.append(reinterpret_cast<const char*>(&which), sizeof which);
        const auto known = known_.find(key);
        const auto [at, is_new] =
            next_.try_emplace(std::move(key), known == known_.end() ? numbers_ : known->second);
        if (!is_new) continue;
        if (at->second == numbers_) ++numbers_;
        return at->second;
    }
}

std::vector<int> Chains::of(const Assembly& assembly, const Linkage& linkage) {
    next_.clear();
    next_.reserve(2 * assembly.joints.size());
    std::vector<int> chains(assembly.plates.size(), -1);
    for (const Joint& joint : assembly.joints) {
        const JointPlates plates = plates_of(joint);
        JointBytes values(plates.places, chains);
        values.raw(joint.how.index());
        std::visit([&](const auto& how) { how.fields(how, values); }, joint.how);
        for (const PlacedPlate& one : plates.places) {
            const int twin = linkage.twin(one.plate);
            if (twin != one.plate && chains[static_cast<std::size_t>(twin)] >= 0)
                values.raw(chains[static_cast<std::size_t>(twin)]);
        }
        const int first = number_of(std::move(values.bytes));
        for (std::size_t i = 0; i < plates.places.size(); ++i) {
            if (i == 0) {
                chains[static_cast<std::size_t>(plates.places[i].plate)] = first;
                continue;
            }
            JointBytes further(plates.places, chains);
            further.raw(first);
            further.raw(i);
            chains[static_cast<std::size_t>(plates.places[i].plate)] = number_of(std::move(further.bytes));
        }
    }
    std::swap(known_, next_);
    return chains;
}

}  // namespace popup
