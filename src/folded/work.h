// How much may be spent on finding how a sheet folds: counted in steps that are the same on every machine, so
// that the same sheet is given up everywhere, or nowhere.
#pragma once

namespace popup::folded {

// One step is about one multiplication of a factorisation, with what stands around it some five instructions.
class Work {
 public:
    // What is spent on one sheet, loops that are tried in several ways included: some 5 s.
    static constexpr double kOfASheet = 9e9;

    explicit Work(double most = kOfASheet) : most_(most), left_(most) {}

    // Whether so many steps are left. If they are, they are spent now.
    bool spend(double steps) {
        if (!has(steps)) {
            left_ = 0.0;
            return false;
        }
        left_ -= steps;
        return true;
    }
    [[nodiscard]] bool has(double steps) const { return steps <= left_; }
    [[nodiscard]] bool is_spent() const { return left_ <= 0.0; }
    [[nodiscard]] double most() const { return most_; }
    [[nodiscard]] double spent() const { return most_ - left_; }

 private:
    double most_ = 0.0, left_ = 0.0;
};

}  // namespace popup::folded
