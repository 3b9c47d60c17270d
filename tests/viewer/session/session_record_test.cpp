// SPDX-License-Identifier: BSD-3-Clause
// A session is recorded, and carried out again to the same bytes; what is no record is refused with place and reason.
#include "experiments/viewer/session/session_record.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "core/math/portable_random.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/viewer/session/segment_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/viewer/session/session_run.hpp"

namespace polhode::viewer::session_record_test {
namespace {

template <class List>
const auto& one_of(PortableRandom& random, const List& list) {
  return list[static_cast<std::size_t>(random.below(static_cast<int>(list.size())))];
}
std::size_t place_in(PortableRandom& random, const std::string& text) {
  return static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// The last digest of a record.
std::string recorded_end(const std::string& text) {
  const auto at = text.rfind("digest = \"");
  return at == std::string::npos ? "" : text.substr(at + 10, 16);
}

const std::vector<std::string> fixed_methods = {"rk4", "semi_implicit_euler", "implicit_midpoint"};

/// Changes something that the scenario allows.
void change_something(Session& session, PortableRandom& random) {
  Configuration c = session.view()->configuration;
  switch (random.below(6)) {
    case 0: choose_integrator(c, one_of(random, fixed_methods), 0.01); break;
    case 1:
      choose_integrator(c, "cvode_adams", 0, 1e-7);
      c.drive = Drive::accumulator;
      break;
    case 2:
      if (c.run.dt) c.run.dt = random.uniform(0.005, 0.02);
      break;
    case 3: c.run.formulation.orientation = random.below(2) ? Orientation::matrix : Orientation::quaternion; break;
    case 4:
      c.run.formulation.angular_state = random.below(2) ? AngularState::velocity_body : AngularState::momentum_world;
      break;
    default: c.drive = random.below(2) ? Drive::frame_clock : Drive::accumulator;
  }
  if (c.run.contact) c.run.contact->impact_timing = c.run.dt && random.below(2) ? "time_stepping" : "event_located";
  session.change(c);
}

/// Whatever a hand may do.
void do_anything(Session& session, PortableRandom& random) {
  switch (random.below(9)) {
    case 0: session.pause(); break;
    case 1: session.step(random.below(20)); break;
    case 2: session.scrub(random.uniform(0, 1.5)); break;
    case 3:
      if (random.below(4) == 0) session.reset();
      break;
    case 4: session.set_speed(random.uniform(0.5, 3)); break;
    case 5: change_something(session, random); break;
    case 6: session.pause_on_collision(random.below(2) == 0); break;
    default: session.play();
  }
  for (int k = random.below(6); k > 0; --k) {
    session.tick(random.uniform(0, 0.03));
    if (random.below(3) == 0) session.settle();
  }
}

class Recorded : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Sessions, Recorded, testing::Values("peters_hsu", "two_bodies", "bouncing_ball", "two_cubes"),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(Recorded, RunsAgainToTheSameBytes) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    PortableRandom random(seed);
    std::int64_t segments = 0;
    {
      const auto session = open(GetParam(), with(GetParam(), "rk4", 0.01, 3), folder.path());
      for (int k = 0; k < 60; ++k) do_anything(*session, random);
      segments = settled(*session)->status.segment;
    }
    const std::string text = text_of(folder.path() / "session.toml");
    SCOPED_TRACE(text);
    const Rerun again = rerun((folder.path() / "session.toml").string());
    ASSERT_EQ(again.mismatch, "");
    EXPECT_EQ(again.segments, segments);
    EXPECT_GT(segments, 3);
    const SessionRecord record = parse_session(text, "session.toml");
    if (record.segments.back().parts.empty()) continue;
    EXPECT_EQ(again.digest, recorded_end(text));
  }
}

// The content of the file after each command is enough to come to the state after it.
TEST(SessionRecord, NothingIsLostWhereItIsKilled) {
  const TemporaryFolder folder;
  const auto session = open("peters_hsu", with("peters_hsu", "rk4", 0.01, 10), folder.path());
  const auto come_to = [&] {
    write(folder.path() / "copy.toml", text_of(folder.path() / "session.toml"));
    const Rerun again = rerun((folder.path() / "copy.toml").string());
    EXPECT_EQ(again.mismatch, "");
    return again.end.t;
  };
  const auto expect_no_loss = [&] {
    const double t = settled(*session)->frame.t;
    EXPECT_EQ(come_to(), t);
  };
  EXPECT_EQ(come_to(), 0);
  session->step(30);
  expect_no_loss();
  session->play();
  for (int k = 0; k < 5; ++k) {
    session->tick(0.25);
    session->settle();
  }
  EXPECT_GT(come_to(), 1) << "each second that it plays";
  Configuration c = session->view()->configuration;
  c.drive = Drive::frame_clock;
  session->change(c);
  for (int k = 0; k < 7; ++k) {
    session->tick(0.013 + 0.001 * k);
    session->settle();
  }
  session->pause();
  expect_no_loss();
  session->scrub(0.2);
  session->step(1);
  expect_no_loss();
  session->reset();
  expect_no_loss();
}

// The record and its scenario can be moved together.
TEST(SessionRecord, AScenarioOfItsOwnIsFoundFromTheRecord) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "here", other = folder.path() / "there";
  std::filesystem::create_directories(place);
  write(place / "top.toml", "t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 2, 3]\nangular_velocity = [0, 1, 2]\n");
  for (const char* record : {"session.toml", "records/session.toml"}) {
    SessionSetup setup;
    setup.scenario = (place / "top.toml").string();
    setup.record = place / record;
    {
      const auto session = live_session(setup);
      session->step(10);
      session->settle();
    }
    EXPECT_EQ(text_of(setup.record).find(folder.path().string()), std::string::npos);
    EXPECT_EQ(rerun(setup.record.string()).mismatch, "");
  }
  std::filesystem::rename(place, other);
  EXPECT_EQ(rerun((other / "session.toml").string()).mismatch, "");
  EXPECT_EQ(rerun((other / "records/session.toml").string()).steps, 10);
}

TEST(SessionRecord, AMismatchIsSaid) {
  const TemporaryFolder folder;
  {
    const auto session = open("peters_hsu", with("peters_hsu", "rk4", 0.01, 10), folder.path());
    session->step(100);
    session->settle();
  }
  const auto path = folder.path() / "session.toml";
  std::string text = text_of(path);
  const auto put = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    other.replace(other.find(from), from.size(), to);
    write(path, other);
    return rerun(path.string()).mismatch;
  };
  EXPECT_EQ(put("steps = 100", "steps = 100"), "");
  EXPECT_THAT(put("dt = 0.01", "dt = 0.02"), testing::HasSubstr("segment 1, step 100, t = 2 s: the state is"));
  EXPECT_THAT(put("steps = 100", "steps = 1001"), testing::HasSubstr("segment 1 ends after 1000 of 1001 steps"));
}

TEST(SessionRecord, NumbersReadBackExactly) {
  const TemporaryFolder folder;
  std::vector<double> sizes;
  {
    Configuration c = with("peters_hsu", "rk4", 0.1 + 0.2, 10);
    c.drive = Drive::frame_clock;
    const auto session = open("peters_hsu", c, folder.path());
    session->play();
    PortableRandom random(3);
    for (int k = 0; k < 200; ++k) {
      sizes.push_back(random.uniform(1e-9, 0.02));
      session->tick(sizes.back());
      session->settle();
    }
  }
  const SessionRecord record = read_session((folder.path() / "session.toml").string());
  ASSERT_EQ(record.segments.size(), 1u);
  EXPECT_EQ(record.segments[0].configuration.run.dt, 0.1 + 0.2);
  std::vector<double> read;
  for (const SegmentPart& part : record.segments[0].parts)
    read.insert(read.end(), part.sizes.begin(), part.sizes.end());
  EXPECT_EQ(read, sizes);
  EXPECT_EQ(rerun((folder.path() / "session.toml").string()).mismatch, "");
}

std::string a_record() {
  const TemporaryFolder folder;
  {
    SessionSetup setup;
    setup.scenario = "two_cubes";
    setup.overrides = {{"body.0.mass", "2.5"}};
    setup.record = folder.path() / "s.toml";
    const auto session = live_session(setup);
    session->step(30);
    session->settle();
    session->scrub(0.01);
    session->step(3);
    session->settle();
    Configuration c = session->view()->configuration;
    c.drive = Drive::frame_clock;
    session->change(c);
    session->step(4);
    session->settle();
  }
  return text_of(folder.path() / "s.toml");
}

std::string fault(const std::string& text) {
  try {
    parse_session(text, "s.toml");
    return "";
  } catch (const study::InputError& error) {
    return error.what();
  }
}

TEST(SessionRecord, FaultsAreSaidWithTheirPlace) {
  const std::string text = a_record();
  ASSERT_EQ(fault(text), "");
  const auto after = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    const auto at = other.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return fault(other.replace(at, from.size(), to));
  };
  EXPECT_THAT(after("version = 1", "version = 2"), testing::StartsWith("s.toml:2:11: version: "));
  EXPECT_THAT(after("scenario = \"two_cubes\"", "scenario = \"two_cubs\""),
              testing::HasSubstr("did you mean 'two_cubes'"));
  EXPECT_THAT(after("\"2.5\"", "\"3.5\""), testing::HasSubstr("not the one that was recorded"));
  EXPECT_THAT(after("\"2.5\"", "\"-1\""), testing::StartsWith("s.toml:8: override.0: "));
  EXPECT_THAT(after("\"rk4\"", "\"rk5\""), testing::HasSubstr("no integrator is called 'rk5'"));
  EXPECT_THAT(after("steps = 30", "steps = 2.5"),
              testing::HasSubstr("segment.0.part.0.steps: 2.5 is not a valid steps"));
  EXPECT_THAT(after("from_segment = 1", "from_segment = 2"), testing::HasSubstr("segment.1.from_segment"));
  EXPECT_THAT(after("from_step = 10", "from_step = 31"), testing::HasSubstr("segment.1.from_step"));
  EXPECT_THAT(after("drive = \"accumulator\"", "drive = \"clock\""), testing::HasSubstr("segment.0.drive"));
  EXPECT_THAT(after("dt = ", "tt = "), testing::HasSubstr("there is no such key"));
  EXPECT_THAT(after("]]\nsteps = 30\ndigest = \"", "]]\nsteps = 30\ndigest = \"x"),
              testing::HasSubstr("16 hexadecimal digits"));
  EXPECT_THAT(after("version = 1", "version ="), testing::StartsWith("s.toml:2:"));
  EXPECT_THROW(read_session("no/such/file.toml"), study::InputError);
  EXPECT_THROW(read_session("/"), study::InputError);
}

// Their options have another order, and there are options that they do not have.
TEST(SessionRecord, FilesOfOlderVersionsAreReadAsBefore) {
  const std::string text = a_record();
  const auto begin = text.find("drive = \"accumulator\""), end = text.find("\n[[segment.part]]", begin);
  ASSERT_NE(end, std::string::npos);
  const std::string old = text.substr(0, begin) + R"(drive = "accumulator"
integrator = "rk4"
dt = 0.001
t_end = 10
orientation = "quaternion"
angular_state = "velocity_world"
gyroscopic = true
rotation_from = "normalized"
normalize = false
broad_phase = "sweep_and_prune"
narrow_phase = "sat"
response = "sequential_impulses"
impact_timing = "time_stepping"
)" + text.substr(end);
  const study::RunConfig run = parse_session(old, "s.toml").segments.at(0).configuration.run;
  EXPECT_TRUE(run.formulation.gyroscopic);
  EXPECT_FALSE(run.normalize);
  EXPECT_EQ(run.contact->narrow_phase, "sat");
  const TemporaryFolder folder;
  write(folder.path() / "s.toml", old);
  EXPECT_EQ(rerun((folder.path() / "s.toml").string()).mismatch, "");
}

TEST(SessionRecord, ASettingOfTheMethodIsKeptAndChecked) {
  const TemporaryFolder folder;
  Configuration c = with("peters_hsu", "arkode_erk", 0, 10);
  c.run.settings["order"] = 3;
  {
    const auto session = open("peters_hsu", c, folder.path());
    session->step(10);
    session->settle();
  }
  const std::string text = text_of(folder.path() / "session.toml");
  EXPECT_THAT(text, testing::HasSubstr("\norder = 3\ntolerance = 1e-08\nt_end = 10\n"));
  EXPECT_EQ(rerun((folder.path() / "session.toml").string()).mismatch, "");
  EXPECT_EQ(parse_session(text, "s.toml").segments.at(0).configuration.run.settings, c.run.settings);
  const auto with_order = [&](std::string other, const std::string& order) {
    return fault(other.replace(other.find("order = 3"), 9, order));
  };
  EXPECT_THAT(with_order(text, "order = 9"), testing::HasSubstr("segment.0: arkode_erk has the orders 2 to 8, not 9"));
  EXPECT_THAT(with_order(text, "order = 2.5"), testing::HasSubstr("segment.0.order: 2.5"));
  std::string adams = text;
  adams.replace(adams.find("arkode_erk"), 10, "cvode_adams");
  EXPECT_THAT(fault(adams), testing::HasSubstr("segment.0: cvode_adams takes no order; leave it out"));
  choose_integrator(c, "rk4");
  EXPECT_TRUE(c.run.settings.empty());
}

TEST(SessionRecordFuzz, MutatedRecordsAreReadOrRefused) {
  const std::string text = a_record();
  const std::vector<std::string> snippets = {"-1",
                                             "nan",
                                             "inf",
                                             "1e300",
                                             "\"",
                                             "[",
                                             "]",
                                             "=",
                                             "\n",
                                             "0",
                                             "true",
                                             "\x80",
                                             "rk4",
                                             "1.5",
                                             "[[segment]]\n",
                                             "[[segment.part]]\n",
                                             "steps = 5\n",
                                             "sizes = [0.1]\n",
                                             "from_segment = 1\n"};
  PortableRandom random(5);
  int read_well = 0;
  constexpr int rounds = 3000;
  for (int i = 0; i < rounds && !testing::Test::HasFailure(); ++i) {
    std::string other = text;
    for (int m = 1 + random.below(3); m > 0 && !other.empty(); --m) {
      const std::size_t at = place_in(random, other);
      switch (random.below(4)) {
        case 0: other.insert(at, one_of(random, snippets)); break;
        case 1: other.erase(at, 1 + place_in(random, "twelve bytes")); break;
        case 2: other[at] = static_cast<char>(random.below(256)); break;
        default: {  // a line goes, or stands twice
          const auto begin = other.rfind('\n', at == 0 ? 0 : at - 1) + 1,
                     end = std::min(other.find('\n', begin), other.size());
          const std::string line = other.substr(begin, end + 1 - begin);
          if (random.below(2) == 0) other.erase(begin, line.size());
          else other.insert(begin, line);
        }
      }
    }
    SCOPED_TRACE(other);
    const std::string what = fault(other);
    if (what.empty()) {
      ++read_well;
      continue;
    }
    EXPECT_TRUE(what.starts_with("s.toml:") || what.starts_with("s.toml: ")) << what;
    EXPECT_EQ(what.find_first_of("\n\r"), std::string::npos) << what;
  }
  EXPECT_GT(read_well, rounds / 100);
  EXPECT_LT(read_well, rounds / 2);
}

}  // namespace
}  // namespace polhode::viewer::session_record_test
