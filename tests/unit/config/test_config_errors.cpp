// Mistakes in a case: each kind is found, at its place, with advice, and nothing else is reported.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "bad_cases.hpp"
#include "config/case_file.hpp"
#include "config/nearest_name.hpp"
#include "config/toml_source.hpp"
#include "config/utf8.hpp"

namespace sphdrop::testing {
namespace {

TEST(BadCases, TheGoodCaseIsGood) {
  const ParsedCase parsed = parse_case_text(good_case, "good.cfg");
  EXPECT_TRUE(parsed.warnings.empty());
  EXPECT_EQ(parsed.values.solid.length, 8e-3);
}

TEST(BadCases, AreReportedWithPlaceAndAdvice) {
  for (const BadCase& bad : bad_cases()) {
    SCOPED_TRACE(bad.kind);
    const std::vector<std::string> messages = messages_for(bad);
    EXPECT_EQ(messages.size(), bad.expected.size());
    for (std::size_t i = 0; i < std::min(messages.size(), bad.expected.size()); ++i) {
      EXPECT_TRUE(messages[i].starts_with(bad.expected[i].front())) << messages[i] << "\nshould start with\n"
                                                                    << bad.expected[i].front();
      for (const std::string& fragment : bad.expected[i]) {
        EXPECT_NE(messages[i].find(fragment), std::string::npos) << messages[i] << "\nlacks\n" << fragment;
      }
    }
    if (messages.size() != bad.expected.size()) {
      for (const std::string& message : messages) ADD_FAILURE() << message;
    }
  }
}

TEST(BadCases, AreManyAndDistinct) {
  std::set<std::string> kinds;
  for (const BadCase& bad : bad_cases()) EXPECT_TRUE(kinds.insert(bad.kind).second) << bad.kind;
  EXPECT_GE(kinds.size(), 45u);
}

TEST(BadCases, ErrorTextHoldsAllMistakes) {
  const BadCase many = bad_cases().back();
  try {
    parse_case_text(many.text, "bad.cfg", many.overrides);
    FAIL() << "accepted";
  } catch (const CaseError& error) {
    ASSERT_EQ(error.mistakes().size(), 7u);
    for (const std::string& mistake : error.mistakes())
      EXPECT_NE(std::string(error.what()).find(mistake), std::string::npos);
  }
}

std::string file_error(const std::string& path) {
  try {
    read_case_file(path);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "accepted";
}

class CaseFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "sphdrop_case_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(CaseFiles, MissingFileAndFolderAreNamed) {
  EXPECT_EQ(file_error((folder_ / "none.cfg").string()), (folder_ / "none.cfg").string() + ": there is no such file");
  EXPECT_NE(file_error(folder_.string()).find("this is a folder"), std::string::npos);
}

TEST_F(CaseFiles, UnreadableFileIsNamed) {
  const std::string path = (folder_ / "secret.cfg").string();
  std::ofstream(path) << good_case;
  ASSERT_EQ(chmod(folder_.c_str(), 0755), 0);
  ASSERT_EQ(chmod(path.c_str(), 0), 0);
  const uid_t user = geteuid();
  if (user == 0) {
    ASSERT_EQ(seteuid(65534), 0);  // root may read everything
  }
  const std::string error = file_error(path);
  if (user == 0) {
    ASSERT_EQ(seteuid(0), 0);
  }
  EXPECT_EQ(error, path + ": cannot be opened: Permission denied");
}

TEST_F(CaseFiles, LinkToItselfIsNamed) {
  const std::filesystem::path path = folder_ / "loop.cfg";
  std::filesystem::create_symlink(path, path);
  EXPECT_NE(file_error(path.string()).find("loop.cfg: cannot be opened: Too many levels"), std::string::npos);
}

TEST_F(CaseFiles, EndlessFileIsRefused) {
  EXPECT_NE(file_error("/dev/zero").find("larger than"), std::string::npos);
}

TEST_F(CaseFiles, FileAndTextGiveTheSame) {
  const std::string path = (folder_ / "drop on beam.cfg").string();
  std::ofstream(path) << good_case.substr(good_case.find('\n') + 1);
  const ParsedCase parsed = read_case_file(path, {"drop.seed=7"});
  EXPECT_EQ(parsed.values.name, "drop on beam");
  EXPECT_EQ(parsed.values.output.directory, "results/drop on beam");
  EXPECT_EQ(parsed.values.drop.seed, 7);
}

// Whatever is cut off or replaced, the answer is a case or a CaseError.
TEST(BadCases, DamagedTextNeverEscapesTheErrorType) {
  const std::string damage = "\"'[]{}=.#\n\\x0-\xff\x01";
  for (std::size_t at = 0; at < good_case.size(); ++at) {
    std::vector<std::string> texts = {good_case.substr(0, at), good_case.substr(at)};
    for (const char c : damage) {
      texts.push_back(good_case);
      texts.back()[at] = c;
    }
    for (const std::string& text : texts) {
      try {
        parse_case_text(text, "damaged.cfg");
      } catch (const CaseError& error) {
        ASSERT_FALSE(error.mistakes().empty());
        for (const std::string& mistake : error.mistakes()) ASSERT_TRUE(mistake.starts_with("damaged.cfg:")) << mistake;
      }
    }
  }
}

TEST(Utf8, AcceptsAllLengthsAndRefusesMalformed) {
  EXPECT_EQ(first_invalid_utf8("a\xc3\xb6\xe2\x82\xac\xf0\x9f\x92\xa7"), std::nullopt);
  EXPECT_EQ(first_invalid_utf8("ab\xe2\x82"), 2u);        // cut off
  EXPECT_EQ(first_invalid_utf8("\xed\xa0\x80"), 0u);      // surrogate
  EXPECT_EQ(first_invalid_utf8("a\x80"), 1u);             // continuation alone
  EXPECT_EQ(first_invalid_utf8("\xf4\x90\x80\x80"), 0u);  // beyond U+10FFFF
}

TEST(NearestName, CountsEditsAndKeepsItsDistance) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("ruond", "round"), 1u);
  EXPECT_EQ(edit_distance("Round", "rOUND"), 0u);
  const std::string_view names[] = {"round", "square", "none"};
  EXPECT_EQ(nearest_name("sqare", names), "square");
  EXPECT_EQ(nearest_name("triangle", names), std::nullopt);
  EXPECT_EQ(nearest_name("", names), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(100000, 'r'), names), std::nullopt);
}

}  // namespace
}  // namespace sphdrop::testing
