// JSON as the program writes it: the text itself, and that an independent parser accepts the worst of it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "io/json.hpp"

namespace sphdrop {
namespace {

TEST(JsonString, EscapesWhatMustBe) {
  EXPECT_EQ(json_string("plain"), "\"plain\"");
  EXPECT_EQ(json_string("a\"b\\c"), R"("a\"b\\c")");
  EXPECT_EQ(json_string("line\nnext\ttab\r"), R"("line\nnext\ttab\u000d")");
  EXPECT_EQ(json_string(std::string_view("\0\x1f\x7f", 3)), R"("\u0000\u001f\u007f")");
}

TEST(JsonString, KeepsWellFormedUtf8AndReplacesTheRest) {
  EXPECT_EQ(json_string("\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x92\xA7"), "\"\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x92\xA7\"");
  const std::string bad = "\xEF\xBF\xBD";
  EXPECT_EQ(json_string("a\xFFz"), "\"a" + bad + "z\"");
  EXPECT_EQ(json_string("\xC3"), "\"" + bad + "\"") << "cut off";
  EXPECT_EQ(json_string("\xC0\xAF"), "\"" + bad + bad + "\"") << "overlong";
  EXPECT_EQ(json_string("\xED\xA0\x80"), "\"" + bad + bad + bad + "\"") << "a surrogate";
  EXPECT_EQ(json_string("\xF4\x90\x80\x80"), "\"" + bad + bad + bad + bad + "\"") << "beyond Unicode";
}

TEST(JsonNumber, IsTheShortestThatReadsBack) {
  EXPECT_EQ(json_number(0.1), "0.1");
  EXPECT_EQ(std::stod(json_number(1.0 / 3.0)), 1.0 / 3.0);
  EXPECT_EQ(json_number(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(json_number(std::nan("")), "null");
}

TEST(JsonObject, KeepsOrderReplacesAndIndents) {
  JsonObject inner;
  inner.set("x", 1);
  JsonObject object;
  EXPECT_EQ(object.text(), "{}");
  object.set("z", "first");
  object.set("a", inner);
  object.set("flag", true);
  object.set("z", "again");
  EXPECT_EQ(object.text(), "{\n  \"z\": \"again\",\n  \"a\": {\n    \"x\": 1\n  },\n  \"flag\": true\n}");
}

TEST(JsonObject, SatisfiesAnotherParser) {
  std::string every_byte;
  for (int byte = 0; byte < 256; ++byte) every_byte += static_cast<char>(byte);
  JsonObject inner;
  inner.set("nan", std::nan(""));
  inner.set("small", 5e-324);
  inner.set("huge", std::numeric_limits<double>::max());
  JsonObject object;
  object.set(every_byte, every_byte);
  object.set("inner", inner);
  object.set("array", std::array<std::string, 2>{"\"", every_byte});
  object.set("largest", std::numeric_limits<std::uint64_t>::max());
  const auto path = std::filesystem::path(testing::TempDir()) / "sphdrop_every_byte.json";
  std::ofstream(path, std::ios::binary) << object.text();
  const std::string check =
      "/usr/bin/python3 -c \"import json,sys; o=json.loads(open(sys.argv[1],'rb').read()); "
      "assert o['largest']==2**64-1 and o['inner']['small']==5e-324 and len(o)==4\" ";
  EXPECT_EQ(std::system((check + path.string()).c_str()), 0);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace sphdrop
