// What designs of a gallery are called: the same wherever one looks from, and never the same for two.
#include "gallery/names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> labels(const GalleryPlan& plan) {
    std::vector<std::string> all;
    for (const GalleryDesign& one : plan.designs) all.push_back(one.label);
    return all;
}

std::string name_of(const std::string& label) {
    const ScratchDirectory scratch;
    const GalleryPlan plan = plan_gallery({scratch.path()}, {scratch / label});
    return plan.designs.size() == 1 ? plan.designs.front().name : "(none)";
}

class InDirectory {
 public:
    explicit InDirectory(const fs::path& path) : before_(fs::current_path()) { fs::current_path(path); }
    InDirectory(const InDirectory&) = delete;
    InDirectory& operator=(const InDirectory&) = delete;
    ~InDirectory() { fs::current_path(before_); }

 private:
    fs::path before_;
};

TEST(GalleryNames, LabelsCountFromWhatAllArgumentsHaveInCommon) {
    const ScratchDirectory scratch;
    for (const char* folder : {"a/b", "a/c"}) fs::create_directories(scratch / folder);
    write_file(scratch / "a/b/x.xml", "");
    write_file(scratch / "a/c/y.xml", "");
    const std::string top = scratch.path();
    const auto of = [&top](const std::vector<std::string>& arguments, const std::vector<std::string>& files) {
        std::vector<std::string> from;
        std::vector<std::string> all;
        for (const std::string& one : arguments) from.push_back(top + one);
        for (const std::string& one : files) all.push_back(top + one);
        return labels(plan_gallery(from, all));
    };
    using Labels = std::vector<std::string>;
    EXPECT_EQ(of({"/a"}, {"/a/b/x.xml", "/a/c/y.xml"}), (Labels{"b/x.xml", "c/y.xml"}));
    EXPECT_EQ(of({"/a/"}, {"/a/b/x.xml"}), (Labels{"b/x.xml"}));
    EXPECT_EQ(of({"/a/b", "/a/c"}, {"/a/b/x.xml", "/a/c/y.xml"}), (Labels{"b/x.xml", "c/y.xml"}));
    EXPECT_EQ(of({"/a/b/x.xml"}, {"/a/b/x.xml"}), (Labels{"x.xml"}));
    EXPECT_EQ(of({"/a/b/x.xml", "/a/c/y.xml"}, {"/a/b/x.xml", "/a/c/y.xml"}), (Labels{"b/x.xml", "c/y.xml"}));
    EXPECT_EQ(of({"/a/b/x.xml", "/a/b/../b/x.xml"}, {"/a/b/x.xml", "/a/b/../b/x.xml"}), (Labels{"x.xml"}));
    EXPECT_EQ(of({"/a/b/gone.xml"}, {"/a/b/gone.xml"}), (Labels{"gone.xml"}));

    const InDirectory inside(scratch / "a");
    EXPECT_EQ(labels(plan_gallery({"."}, {"b/x.xml"})), (Labels{"b/x.xml"}));
    EXPECT_EQ(labels(plan_gallery({"b", "../a/c"}, {"b/x.xml", "../a/c/y.xml"})),
              (Labels{"b/x.xml", "c/y.xml"}));
    EXPECT_EQ(fs::path(plan_gallery({"b", "c"}, {}).root), fs::canonical(scratch / "a"));
}

TEST(GalleryNames, PlainNamesStayAndOthersHaveADigest) {
    EXPECT_EQ(name_of("castle.xml"), "castle");
    EXPECT_EQ(name_of("a_b-2.xml"), "a_b-2");
    EXPECT_EQ(name_of("castle.fl"), "castle-fl-e523fb0def");
    EXPECT_EQ(name_of("Castle.xml").substr(0, 11), "castle-xml-");
    EXPECT_EQ(name_of("a/castle.xml").substr(0, 13), "a-castle-xml-");
    EXPECT_EQ(name_of("a-castle.xml"), "a-castle");
}

TEST(GalleryNames, WhateverFilesAreCalledTheirNamesAreTame) {
    const std::vector<std::string> hostile{"castle.xml",
                                           "Castle.xml",
                                           "CASTLE.xml",
                                           "castle.fl",
                                           "castle.oa",
                                           "a/castle.xml",
                                           "b/castle.xml",
                                           "a-castle.xml",
                                           "<script>alert(1)</script>.xml",
                                           "\"quoted\".xml",
                                           "'.xml",
                                           "line\nbreak.xml",
                                           "line break.xml",
                                           "line-break.xml",
                                           "\xff\xfe.xml",
                                           "\xff\xfd.xml",
                                           "..xml",
                                           "...xml",
                                           ".xml",
                                           "-.xml",
                                           "--help.xml",
                                           "%2e%2e.xml",
                                           "caf\xc3\xa9.xml",
                                           "cafe\xcc\x81.xml",
                                           "&amp;.xml",
                                           "&.xml",
                                           "index.xml",
                                           std::string(250, 'x') + ".xml",
                                           std::string(249, 'x') + "y.xml",
                                           "castle-0123456789.xml",
                                           "0123456789.xml"};
    const ScratchDirectory scratch;
    std::vector<std::string> files;
    for (const std::string& one : hostile) files.push_back(scratch.path().string() + "/" + one);
    const GalleryPlan plan = plan_gallery({scratch.path()}, files);
    ASSERT_EQ(plan.designs.size(), hostile.size());
    std::set<std::string> names;
    for (const GalleryDesign& one : plan.designs) {
        EXPECT_TRUE(names.insert(one.name).second) << one.name << " of " << one.label;
        EXPECT_TRUE(!one.name.empty() && one.name.size() <= 100) << one.name;
        EXPECT_EQ(one.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_"), std::string::npos)
            << one.name;
        EXPECT_EQ(unescaped_name(escaped_name(one.label)), one.label);
        EXPECT_TRUE(std::find(hostile.begin(), hostile.end(), one.label) != hostile.end()) << one.label;
    }
}

// No design that comes or goes changes what others are called.
TEST(GalleryNames, AreOfEachDesignAlone) {
    const ScratchDirectory scratch;
    const std::string top = scratch.path();
    const GalleryPlan both = plan_gallery({top}, {top + "/a/x.xml", top + "/x.xml", top + "/X.xml"});
    for (const GalleryDesign& one : both.designs) {
        const GalleryPlan alone = plan_gallery({top}, {top + "/" + one.label});
        EXPECT_EQ(alone.designs.front().name, one.name);
    }
}

TEST(GalleryNames, TilesComeAsPeopleCount) {
    std::vector<std::string> labels{"card10.xml", "Card2.xml", "card02.xml", "b/a.xml",
                                    "a.xml",      "B.xml",     "card2.xml"};
    std::sort(labels.begin(), labels.end(), label_before);
    EXPECT_EQ(labels, (std::vector<std::string>{"a.xml", "B.xml", "b/a.xml", "Card2.xml", "card02.xml",
                                                "card2.xml", "card10.xml"}));
    for (const std::string& a : labels) {
        EXPECT_FALSE(label_before(a, a));
        for (const std::string& b : labels)
            EXPECT_TRUE(a == b || label_before(a, b) != label_before(b, a)) << a << b;
    }
}

}  // namespace
}  // namespace popup::test
