// The verb `measure`, on scenes so small that its runs take milliseconds.
#include "app/command_line.h"
#include "app/measure/reference.h"
#include "app/measure/summary.h"
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "tests/support/command_run.h"
#include "tests/support/temporary_directory.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cellcut::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Keeps the references in a folder of the test's own.
class MeasureTest : public testing::Test {
 protected:
  void SetUp() override { setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
  void TearDown() override { unsetenv("XDG_CACHE_HOME"); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// A measurement of two strategies with 20 lights.
  std::vector<std::string> arguments(const std::string& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> args{
        "measure",         "hall", "--lights", "20", "-o",          path(output), "--size",       "24x16",
        "--spp",           "5",    "--runs",   "2",  "--max-depth", "2",          "--strategies", "cell-cut,uniform",
        "--reference-spp", "256"};
    args.insert(args.end(), more.begin(), more.end());
    return args;
  }
  Outcome measure(const std::string& output, const std::vector<std::string>& more = {}, std::ostream* err = nullptr) {
    return runCommand(arguments(output, more), err);
  }
  /// Not of hall, whose tiny emitters are seen directly: the error of a reference of hundreds of passes is one of luck there.
  std::vector<std::string> ofRooms(const std::string& output, const std::vector<std::string>& more = {}) {
    auto args = arguments(output, more);
    *std::find(args.begin(), args.end(), "hall") = "rooms";
    return args;
  }
  /// With another number of them, or without the option.
  static std::vector<std::string> withReferencePasses(const std::string& passes, std::vector<std::string> args) {
    const auto option = std::find(args.begin(), args.end(), "--reference-spp");
    option[1] = passes;
    if (passes.empty()) args.erase(option, option + 2);
    return args;
  }
  nlohmann::json results(const std::string& output) const {
    std::ifstream file(folder_ / output / "results.json");
    return nlohmann::json::parse(file);
  }
  std::string contents(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Everything but times.
  static std::string errorsOf(const nlohmann::json& results) {
    std::map<std::string, std::string> runs;
    for (nlohmann::json run : results.at("runs")) {
      run.erase("build_seconds");
      for (nlohmann::json& c : run.at("checkpoints")) {
        c.erase("seconds");
        c.erase("pass_seconds");
      }
      runs[run.at("configuration").get<std::string>() + run.at("run").dump()] = run.dump();
    }
    std::string text;
    for (const auto& [name, run] : runs) text += run + "\n";
    return text;
  }
  test::TemporaryDirectory folder_;
};

/// RFC 4180 without line breaks in fields.
std::vector<std::map<std::string, std::string>> parseCsv(const std::string& text) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    EXPECT_THAT(line, testing::EndsWith("\r"));
    std::vector<std::string> fields{""};
    bool quoted = false;
    for (const char c : line.substr(0, line.size() - 1)) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) {
        fields.emplace_back();
      } else {
        fields.back() += c;
      }
    }
    lines.push_back(fields);
  }
  std::vector<std::map<std::string, std::string>> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].size(), lines[0].size());
    for (std::size_t k = 0; k < lines[i].size(); ++k) {
      if (k == 0) rows.emplace_back();
      rows.back()[lines[0][k]] = lines[i][k];
    }
  }
  return rows;
}

TEST_F(MeasureTest, WritesEveryCheckpointOfEveryRunInterleaved) {
  const Outcome outcome = measure("a");
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const auto json = results("a");
  std::vector<std::string> order;
  for (const auto& run : json.at("runs")) {
    order.push_back(run.at("configuration").get<std::string>() + " " + run.at("run").dump() + " " +
                    run.at("seed").dump());
    std::vector<int> passes;
    double seconds = 0;
    for (const auto& c : run.at("checkpoints")) {
      passes.push_back(c.at("spp"));
      EXPECT_GT(c.at("relmse"), 0);
      EXPECT_GT(c.at("seconds"), seconds);
      seconds = c.at("seconds");
    }
    EXPECT_THAT(passes, testing::ElementsAre(1, 2, 4, 5));
  }
  EXPECT_THAT(order, testing::ElementsAre("hall-20-depth2.cell-cut 0 0", "hall-20-depth2.uniform 0 0",
                                          "hall-20-depth2.cell-cut 1 1", "hall-20-depth2.uniform 1 1"));
  EXPECT_EQ(json.at("cases").at(0).at("reference").at("spp"), 256);
  for (const char* name : {"hall-20-depth2.reference", "hall-20-depth2.cell-cut", "hall-20-depth2.uniform"}) {
    EXPECT_EQ(readImage(folder_ / "a" / "images" / (std::string(name) + ".exr")).width(), 24);
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a" / "scenes" / "hall-20.glb"));
}

TEST_F(MeasureTest, TableHoldsTheSummary) {
  ASSERT_EQ(measure("a", {"--sweep", "threshold=0.01,0.0005"}).code, kDone);
  const auto rows = parseCsv(contents("a/results.csv"));
  ASSERT_EQ(rows.size(), 3u * 5);  // 4 checkpoints and the end, of uniform and two thresholds
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("runs"), "2");
    const double low = std::stod(row.at("relmse_low")), value = std::stod(row.at("relmse"));
    EXPECT_LE(low, value);
    EXPECT_LE(value, std::stod(row.at("relmse_high")));
    EXPECT_GT(std::stod(row.at("seconds")), 0);
    EXPECT_EQ(row.at("threshold").empty(), row.at("strategy") == "uniform");
    EXPECT_EQ(row.at("lights"), "20");
  }
  EXPECT_EQ(std::stof(rows[0].at("threshold")), 0.0005f);
  EXPECT_EQ(rows[0].at("base"), "1");
  EXPECT_EQ(rows[5].at("threshold"), "0.01");
  EXPECT_EQ(rows[4].at("at"), "time");
  EXPECT_EQ(rows[4].at("spp"), "5");
}

TEST_F(MeasureTest, RepeatsBitForBit) {
  ASSERT_EQ(measure("a").code, kDone);
  std::filesystem::remove_all(folder_ / "cellcut");  // the reference is made again too
  ASSERT_EQ(measure("b", {"--threads", "1"}).code, kDone);
  EXPECT_EQ(errorsOf(results("a")), errorsOf(results("b")));
  for (const std::string name : {"reference", "cell-cut", "uniform"}) {
    EXPECT_TRUE(contents("a/images/hall-20-depth2." + name + ".png") ==
                contents("b/images/hall-20-depth2." + name + ".png"));
  }
}

TEST_F(MeasureTest, ResumedEndsAsUninterrupted) {
  ASSERT_EQ(measure("a").code, kDone);
  std::filesystem::remove_all(folder_ / "cellcut");
  InterruptingBuffer inReference("reference", 1), inRuns("run ", 2);
  std::ostream first(&inReference), second(&inRuns);
  measure("b", {}, &first);
  EXPECT_EQ(measure("b", {"--resume"}, &second).code, kDone);
  EXPECT_LT(results("b").at("runs").size(), 4u);
  ASSERT_EQ(measure("b", {"--resume"}).code, kDone);
  EXPECT_EQ(results("b").at("runs").size(), 4u);
  EXPECT_EQ(errorsOf(results("a")), errorsOf(results("b")));
  EXPECT_EQ(results("b").at("commands").size(), 3u);
}

TEST_F(MeasureTest, ResumeAddsRuns) {
  ASSERT_EQ(measure("a").code, kDone);
  auto more = arguments("a", {"--resume"});
  *(std::find(more.begin(), more.end(), "--runs") + 1) = "3";
  ASSERT_EQ(runCommand(more).code, kDone);
  EXPECT_EQ(results("a").at("runs").size(), 6u);
}

TEST_F(MeasureTest, NeverOverwritesResults) {
  ASSERT_EQ(measure("a").code, kDone);
  const Outcome again = measure("a");
  EXPECT_EQ(again.code, kBadInput);
  EXPECT_THAT(again.err, HasSubstr("--resume"));
  const Outcome other = measure("a", {"--resume", "--seed", "5"});
  EXPECT_EQ(other.code, kBadInput);
  EXPECT_THAT(other.err, HasSubstr("was made with seed 0 in place of 5; use that"));
  EXPECT_THAT(measure("a", {"--resume", "--threshold", "0.25"}).err,
              HasSubstr("made with parameters/threshold 0.0005"));
  std::ofstream(folder_ / "a" / "results.json") << "{\"settings\": 7}";
  EXPECT_THAT(measure("a", {"--resume"}).err, HasSubstr("made with  7 in place of none"));
  std::ofstream(folder_ / "a" / "results.json") << "{\"settings\": ";
  EXPECT_EQ(measure("a", {"--resume"}).code, kBadInput);
}

TEST_F(MeasureTest, ResultsThatNestWithoutEndAreRefused) {
  std::filesystem::create_directory(folder_ / "a");
  std::ofstream(folder_ / "a" / "results.json")
      << "{\"settings\": " << std::string(100'000, '[') << std::string(100'000, ']') << "}";
  const Outcome outcome = measure("a", {"--resume"});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("results.json: JSON nested more than 128 deep; choose another"));
}

TEST_F(MeasureTest, ReferenceIsMadeOnce) {
  const Outcome first = measure("a");
  ASSERT_EQ(first.code, kDone) << first.err;
  const auto modified = [&] {
    std::map<std::string, std::filesystem::file_time_type> times;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cellcut")) {
      times[entry.path().filename()] = entry.last_write_time();
    }
    return times;
  };
  const auto before = modified();
  ASSERT_EQ(before.size(), 2u);
  ASSERT_EQ(measure("b").code, kDone);
  EXPECT_EQ(modified(), before);
  ASSERT_EQ(measure("c", {"--sweep", "max-depth=1"}).code, kDone);  // another picture, another reference
  EXPECT_EQ(modified().size(), 4u);
}

TEST_F(MeasureTest, ResumeJudgesByTheReferenceThatIsAsked) {
  ASSERT_EQ(runCommand(ofRooms("a")).code, kDone);
  nlohmann::json stopped = results("a");
  stopped["runs"].clear();
  std::ofstream(folder_ / "a" / "results.json") << stopped;
  const Outcome resumed = runCommand(withReferencePasses("512", ofRooms("a", {"--resume"})));
  ASSERT_EQ(resumed.code, kDone) << resumed.err;
  EXPECT_EQ(results("a").at("cases").at(0).at("reference").at("spp"), 512);
  // A coarser one than there is is not made, and runs that one was fine enough for stay.
  EXPECT_EQ(runCommand(ofRooms("a", {"--resume"})).code, kDone);
  EXPECT_EQ(results("a").at("cases").at(0).at("reference").at("spp"), 512);
  const std::string before = errorsOf(results("a"));
  ASSERT_EQ(runCommand(withReferencePasses("1024", ofRooms("a", {"--resume"}))).code, kDone);
  EXPECT_EQ(results("a").at("cases").at(0).at("reference").at("spp"), 1024);
  EXPECT_EQ(errorsOf(results("a")), before);
}

TEST_F(MeasureTest, ReferenceHas16TimesTheSamplesOfARun) {
  EXPECT_THAT(runCommand(withReferencePasses("", arguments("a"))).err,
              HasSubstr("reference of hall-20-depth2: 80 spp"));
}

TEST_F(MeasureTest, NoisyReferenceIsRefused) {
  const Outcome outcome = runCommand(withReferencePasses("4", arguments("a")));
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("--reference-spp"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a" / "results.csv"));
}

TEST_F(MeasureTest, GivenReferenceIsJudgedToo) {
  ASSERT_EQ(runCommand(ofRooms("a")).code, kDone);
  const auto by = [&](const std::string& picture) { return std::vector<std::string>{"--reference", path(picture)}; };
  ASSERT_EQ(runCommand(withReferencePasses("", ofRooms("b", by("a/images/rooms-20-depth2.reference.exr")))).code,
            kDone);
  EXPECT_EQ(errorsOf(results("a")), errorsOf(results("b")));
  EXPECT_LT(results("b").at("cases").at(0).at("reference").at("relmse"),
            results("b").at("runs").at(0).at("checkpoints").at(3).at("relmse"));
  auto resumed = withReferencePasses("", ofRooms("b", by("a/images/rooms-20-depth2.cell-cut.exr")));
  resumed.emplace_back("--resume");
  EXPECT_THAT(runCommand(resumed).err, HasSubstr("--reference: runs in "));
  std::filesystem::copy(path("a/images/rooms-20-depth2.reference.exr"), path("same.exr"));
  resumed = withReferencePasses("", ofRooms("b", by("same.exr")));
  resumed.emplace_back("--resume");
  EXPECT_EQ(runCommand(resumed).code, kDone) << "the same pixels under another name";
  EXPECT_THAT(runCommand(ofRooms("b", {"--resume"})).err, HasSubstr("--reference-spp: runs in "));
  const Outcome outcome = runCommand(withReferencePasses(
      "", ofRooms("c", {"--reference", path("a/images/rooms-20-depth2.cell-cut.exr"), "--seed", "7"})));
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("less noise"));
}

TEST(MeasureReference, IsRefusedAboveATenthOfWhatItJudges) {
  MeasureReference reference;
  reference.relmse = 1e-4;
  reference.passes = 100;
  EXPECT_NO_THROW(requireFineReference(reference, 1.01e-3));
  EXPECT_THROW(requireFineReference(reference, 0.99e-3), InputError);
  reference.relmse = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(requireFineReference(reference, 1e-9));
}

TEST_F(MeasureTest, BadArgumentsAreRefused) {
  const auto refused = [&](const std::vector<std::string>& more, const std::string& reason) {
    const Outcome outcome = measure("refused", more);
    EXPECT_EQ(outcome.code, kBadInput);
    EXPECT_THAT(outcome.err, HasSubstr(reason));
  };
  refused({"--sweep", "colour=1"}, "--sweep: 'colour=1'");
  refused({"--sweep", "threshold"}, "NAME=VALUE");
  refused({"--sweep", "threshold=2"}, "'2'");
  refused({"--sweep", "quality=best"}, "preview, balanced, accurate");
  refused({"--sweep", "max-cut=64,,32"}, "empty");
  refused({"--runs", "0"}, "--runs");
  refused({"--time", "1"}, "excludes");
  refused({"--camera", "nowhere"}, "nowhere");
  EXPECT_THAT(runCommand({"measure", "room", "-o", path("room")}).err,
              HasSubstr("room: is no file, and none of the recipes"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "room"));
  const std::string file = path("a.glb");
  ASSERT_EQ(runCommand({"generate", "kinds", "--lights", "3", "-o", file}).code, kDone);
  const auto ofFile = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"measure", file, "-o", path("file"), "--size", "8x8", "--spp", "1"});
    return runCommand(more);
  };
  EXPECT_THAT(ofFile({"--strategies", "cell-cut,cell-cut"}).err, HasSubstr("twice"));
  EXPECT_THAT(ofFile({"--strategies", "magic"}).err, HasSubstr("uniform, power"));
  EXPECT_THAT(ofFile({"--lights", "5"}).err, HasSubstr("is a file"));
  writePfm(folder_ / "small.pfm", ImageRgb(4, 4, Vec3(1)));
  EXPECT_THAT(ofFile({"--reference", path("small.pfm")}).err, HasSubstr("4x4"));
  EXPECT_THAT(ofFile({"--reference", path("small.pfm"), "--sweep", "max-depth=1,2"}).err, HasSubstr("several depths"));
  EXPECT_THAT(ofFile({"--reference", path("none.exr")}).err, HasSubstr("none.exr"));
}

TEST_F(MeasureTest, ReportNeedsNothingButItself) {
  ASSERT_EQ(measure("a", {"--sweep", "quality=preview,balanced"}).code, kDone);
  const std::string page = contents("a/report.html");
  EXPECT_THAT(page, Not(HasSubstr("of the results\"}")));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,iVBOR"));
  for (const char* outside : {"src=\"http", "href=\"http", "url(http", "@import"})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  const auto data = nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
  EXPECT_EQ(data.at("images").at(0).at("configurations").size(), 2u);
  EXPECT_FALSE(data.at("fronts").at(0).at("points").empty());
}

RunRecord syntheticRun(int run, double factor) {
  RunRecord record{.configuration = 0, .run = run};
  for (const std::uint64_t passes : {1u, 2u, 4u, 8u}) {
    const double seconds = 0.5 * static_cast<double>(passes);
    record.checkpoints.push_back(
        {.passes = passes, .seconds = seconds, .mse = factor / seconds, .relmse = factor / seconds});
  }
  return record;
}

TEST(Summary, ComparesAtTheTimeBetweenCheckpoints) {
  const RunRecord run = syntheticRun(0, 1);
  EXPECT_NEAR(atTime(run, 3).relmse, 1.0 / 3, 1e-12);
  EXPECT_EQ(atTime(run, 3).passes, 6u);
  EXPECT_EQ(atTime(run, 0.1).seconds, 0.5);  // overshot by its first pass: compared where it is
  EXPECT_EQ(atTime(run, 0.1).relmse, 2);
}

TEST(Summary, SlopeAndInefficiencyOfAPerfectRunAreExact) {
  MeasureResults results;
  results.plan.cases = {{"case", {}, 0, 8}};
  results.plan.configurations = {{"one", 0, Strategy::kCellCut, {}, {}, true}};
  results.cases.resize(1);
  results.runs = {syntheticRun(0, 1), syntheticRun(1, 4)};
  const auto rows = summaryOf(results, 3);
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_NEAR(rows[4].inefficiency.value, 2, 1e-12);  // geometric mean of 1 and 4
  EXPECT_NEAR(rows[4].relmse.value, 2.0 / 3, 1e-12);
  EXPECT_NEAR(slopesOf(results, 0).overPasses.value, -1, 1e-12);
  EXPECT_NEAR(slopesOf(results, 0).overSeconds.high, -1, 1e-9);
}

}  // namespace
}  // namespace cellcut::test
