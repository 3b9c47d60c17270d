// SPDX-License-Identifier: BSD-3-Clause
// A run option is one entry of the table for the window too: one that this test adds is found in its command line, in
// its panel and in session files, and so are all others.
#include "experiments/study/record/run_options.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/study/text/input_error.hpp"
#include "experiments/viewer/options.hpp"
#include "experiments/viewer/overlay/panel.hpp"
#include "experiments/viewer/pictures/offscreen.hpp"
#include "experiments/viewer/session/session_record.hpp"
#include "experiments/viewer/window/script.hpp"
#include "integrators/catalogue.hpp"
#include "tests/experiments/study/record/tidiness.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/viewer/session/session_run.hpp"

namespace polhode::viewer::run_options_test {
namespace {

using study::RunOption;
using study::tidiness;
using testing::HasSubstr;

/// The time that a run spends on that, by an entry with few members. No code uses it.
RunOption effort() {
  RunOption option{.name = "effort", .values = "S", .help = "of tidying up", .kind = RunOption::Kind::number};
  option.unit = "s";
  return study::without_member(option);
}

Options parsed(const std::vector<std::string>& more) {
  std::vector<const char*> words = {"viewer"};
  for (const std::string& word : more) words.push_back(word.c_str());
  return parse("How does it move?", int(words.size()), words.data());
}

study::RunConfig run_of(const std::vector<std::string>& more) { return parsed(more).stage.configurations.at(0).run; }

std::string refused(const std::vector<std::string>& more) {
  try {
    parsed(more);
    return "";
  } catch (const study::InputError& error) {
    return error.what();
  }
}

std::string help() {
  testing::internal::CaptureStdout();
  EXPECT_EQ(parsed({"--help"}).exit_status, 0);
  return testing::internal::GetCapturedStdout();
}

/// The panel of a run, without a window.
class RunOptionsPanel : public testing::Test {
 protected:
  static constexpr int width = 1280, height = 720;
  static constexpr float panel_width = 320;

  void SetUp() override {
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    try {
      target_ = std::make_unique<Offscreen>(width, height, 1);
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
    gui_ = std::make_unique<Gui>();
  }

  void open(const std::vector<std::string>& words) { stage_ = std::make_unique<Stage>(parsed(words).stage); }

  void frame() {
    target_->bind();
    gui_->begin_offscreen(width, height, 1.0 / 60);
    panel_.draw(*stage_, gui_->controls, panel_width, float(height));
    gui_->draw();
    stage_->each([](Session& s) { s.settle(); });
    stage_->look_at_all();
  }

  /// Operates the panel as the script says. Throws InputError if the script fails.
  void operate(const std::string& text) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "script.txt").string();
    std::ofstream(file) << text;
    Script script(file, {}, {});
    while (!script.done()) {
      script.before_frame();
      frame();
      script.after_frame(*stage_, gui_->controls);
    }
  }

  const study::RunConfig& run() const { return stage_->views().front()->configuration.run; }

  std::unique_ptr<Offscreen> target_;
  std::unique_ptr<Gui> gui_;
  std::unique_ptr<Stage> stage_;
  Panel panel_;
};

TEST(RunOptionsOfTheWindow, OneEntryIsAllThatTheCommandLineNeeds) {
  const study::AddedRunOption added(tidiness()), also(effort());
  const std::string text = help();
  EXPECT_THAT(text, HasSubstr("--tidy-up never|daily"));
  EXPECT_THAT(text, HasSubstr("when the run tidies up (default: never)"));
  EXPECT_THAT(text, HasSubstr("--effort S"));
  EXPECT_TRUE(run_of({"--record", "off"}).further.empty());
  const study::RunConfig run = run_of({"--tidy-up", "daily", "--effort", "2.5"});
  EXPECT_EQ(run.further.at("tidy-up"), study::OptionValue("daily"));
  EXPECT_EQ(run.further.at("effort"), study::OptionValue(2.5));
  EXPECT_THAT(refused({"--tidy-up", "dayly"}), HasSubstr("--tidy-up: no 'dayly'"));
  EXPECT_THAT(refused({"--tidy-up", "never,daily"}), HasSubstr("--tidy-up: a run has one value"));
  EXPECT_THAT(refused({"--effort", "-1"}), HasSubstr("--effort: -1 is not positive"));
}

TEST(RunOptionsOfTheWindow, OneEntryIsAllThatSessionFilesNeed) {
  const study::AddedRunOption added(tidiness()), also(effort());
  const TemporaryFolder folder;
  const study::Scenario scenario = scenario_of("peters_hsu");
  Configuration c = with("peters_hsu", "rk4", 0.01, 10);
  choose_option(c, study::run_option("tidy-up"), "daily", scenario);
  choose_option(c, study::run_option("effort"), "2.5", scenario);
  {
    const auto session = viewer::open("peters_hsu", c, folder.path());
    session->step(10);
    session->settle();
  }
  const std::string file = (folder.path() / "session.toml").string(), text = text_of(file);
  EXPECT_THAT(text, HasSubstr("tidy_up = \"daily\"\neffort = 2.5\n"));
  EXPECT_EQ(parse_session(text, "s.toml").segments.at(0).configuration.run.further, c.run.further);
  EXPECT_EQ(rerun(file).mismatch, "");
}

TEST_F(RunOptionsPanel, OneEntryIsAllThatItNeeds) {
  const study::AddedRunOption added(tidiness());
  open({"--scenario", "peters_hsu", "--record", "off"});
  operate(
      "wait 2\nexpect tidy_up never\nchoose tidy_up daily\nwait 2\nexpect tidy_up daily\nexpect segment 2\n"
      "choose tidy_up never\nwait 2\nexpect tidy_up never\n");
  EXPECT_EQ(run().further.at("tidy-up"), study::OptionValue("never"));
  stage_.reset();  // before the table changes
}

/// The words of runs that have, together, all options of the window.
std::vector<std::vector<std::string>> runs_with_all_options() {
  std::vector<std::vector<std::string>> runs = {{"dzhanibekov"}, {"spinning_cubes"}, {"falling_chain"}};
  for (const std::string& name : study::run_option("stabilization").known())
    runs.push_back({"double_pendulum", "--stabilization", name});
  for (const IntegratorEntry& method : integrator_catalogue()) {
    if (method.declaration.settings.empty()) continue;
    const bool of_joints = refused({"--scenario", "dzhanibekov", "--integrator", method.declaration.name}) != "";
    runs.push_back({of_joints ? "double_pendulum" : "dzhanibekov", "--integrator", method.declaration.name});
  }
  for (std::vector<std::string>& words : runs) words.insert(words.begin(), {"--record", "off", "--scenario"});
  return runs;
}

TEST_F(RunOptionsPanel, HasAControlForEachOptionThatApplies) {
  std::set<std::string> all, found;
  for (const RunOption* option : chosen_options()) all.insert(option->name);
  for (const std::vector<std::string>& words : runs_with_all_options()) {
    SCOPED_TRACE(testing::PrintToString(words));
    open(words);
    frame();
    std::vector<Controls::Place> places;
    for (const RunOption* option : chosen_options()) {
      const std::string name = option->name == "orientation" ? "chart" : study::file_key(*option);
      const Controls::Place* place = gui_->controls.find(name);
      EXPECT_EQ(place != nullptr, option->applies_to(run())) << option->name;
      if (!place) continue;
      found.insert(option->name);
      EXPECT_GE(place->left, 0) << option->name;
      EXPECT_LE(place->right, panel_width) << option->name;
      for (const Controls::Place& other : places) {
        const bool apart = place->left >= other.right || place->right <= other.left || place->upper >= other.lower ||
                           place->lower <= other.upper;
        EXPECT_TRUE(apart) << option->name << " lies over another control";
      }
      places.push_back(*place);
    }
  }
  EXPECT_EQ(found, all);
}

TEST_F(RunOptionsPanel, OptionsComeAndGoWithThoseThatDecideAboutThem) {
  open({"--scenario", "double_pendulum", "--record", "off"});
  operate(
      "wait 2\nexpect stabilization none\nchoose stabilization baumgarte\nwait 2\nexpect stabilization baumgarte\n"
      "expect baumgarte_alpha none\n");
  EXPECT_NE(gui_->controls.find("baumgarte_alpha"), nullptr);
  EXPECT_EQ(gui_->controls.find("penalty"), nullptr);
  operate("choose stabilization penalty\nwait 2\nexpect stabilization penalty\n");
  EXPECT_NE(gui_->controls.find("penalty"), nullptr);
  operate("choose chart matrix\nwait 2\nexpect rotation_from none\nexpect stabilization penalty\n");
  EXPECT_EQ(gui_->controls.find("rotation_from"), nullptr);
}

TEST(RunOptionsOfTheWindow, AnOptionThatNoLongerAppliesIsLeftOut) {
  const study::Scenario scenario = scenario_of("double_pendulum");
  Configuration c = with("double_pendulum", "rk4", 0.01, 1);
  const auto choose = [&](const char* option, const std::string& text) {
    choose_option(c, study::run_option(option), text, scenario);
  };
  choose("stabilization", "baumgarte");
  choose("baumgarte-alpha", "5");
  choose("summation", "compensated");
  EXPECT_EQ(c.run.joints->alpha, 5);
  choose("baumgarte-alpha", "");
  EXPECT_EQ(c.run.joints->alpha, std::nullopt);
  choose("baumgarte-beta", "7");
  EXPECT_THROW(choose("baumgarte-beta", "much"), study::InputError);
  EXPECT_EQ(c.run.joints->beta, 7) << "unchanged";
  choose("stabilization", "both");
  EXPECT_EQ(c.run.joints->beta, std::nullopt);
  EXPECT_EQ(c.run.summation, study::Summation::compensated) << "all others stay";
  EXPECT_EQ(c.run.dt, 0.01);
  EXPECT_EQ(c.run.t_end, 1);
  choose("t-end", "");
  EXPECT_EQ(c.run.t_end, scenario.t_end);
}

TEST(RunOptionsOfTheWindow, AnOptionThatAppliesAgainHasItsDefault) {
  const study::Scenario scenario = scenario_of("two_cubes");
  Configuration c = with("two_cubes", "rk4", 0.01, 1);
  const auto choose = [&](const char* option, const char* text) {
    choose_option(c, study::run_option(option), text, scenario);
  };
  choose("impact-timing", "event_located");
  choose("response", "simultaneous");
  EXPECT_EQ(c.run.contact->impact_timing, "event_located") << "it applies as before";
  choose("response", "compliant");
  EXPECT_EQ(c.run.contact->impact_timing, "");
  choose("response", "simultaneous");
  EXPECT_EQ(c.run.contact->impact_timing, "time_stepping");
}

TEST(RunOptionsOfTheWindow, OptionsOfJointsAreTakenWhereTheyHaveAnEffect) {
  const study::RunConfig run =
      run_of({"--scenario", "double_pendulum", "--stabilization", "baumgarte", "--baumgarte-alpha", "5"});
  ASSERT_TRUE(run.joints);
  EXPECT_EQ(run.joints->stabilization, Stabilization::baumgarte);
  EXPECT_EQ(run.joints->alpha, 5);
  EXPECT_THAT(refused({"--stabilization", "both"}),
              HasSubstr("--stabilization: it has no effect, because no scenario here has joints; leave it out"));
  EXPECT_THAT(refused({"--scenario", "double_pendulum", "--penalty", "1e6"}), HasSubstr("--penalty: it has no effect"));
  EXPECT_EQ(refused({"--integrator", "rk4,arkode_erk", "--order", "3"}), "") << "it has an effect on one of the runs";
}

TEST(RunOptionsOfTheWindow, EachEntryIsInTheHelp) {
  const std::string text = help();
  std::set<std::string> left_out;
  for (const RunOption& option : study::run_options()) {
    const bool has = text.find("  --" + option.name + " ") != std::string::npos;
    if (!has || option.name == "samples") left_out.insert(option.name);
  }
  // Options of a whole study have no value in a session; --samples are those of a pixel.
  EXPECT_EQ(left_out, (std::set<std::string>{"max-steps", "precision", "reference", "samples"}));
}

}  // namespace
}  // namespace polhode::viewer::run_options_test
