// Tests of sweeps without a GPU: the journal, continuing, rounds, shards and merging, over a meter of made-up numbers.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/sweep/columns.h"
#include "app/sweep/files.h"
#include "app/sweep/html_report.h"
#include "app/sweep/merge.h"
#include "renderer/base/command_text.h"
#include "renderer/base/error.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/projection/light_view.h"
#include "renderer/scene/animation.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/error_text.h"
#include "tests/support/fake_sweep.h"
#include "tests/support/process.h"
#include "tests/support/text.h"

namespace si {
namespace {

using OrderedJson = nlohmann::ordered_json;

TEST(Shards, CoverEachCaseOnce) {
    EXPECT_EQ(parse_shard("2/8"), (Shard{2, 8}));
    for (const char* wrong : {"", "0/2", "3/2", "1/0", "1/2/3", "1", "a/b", "1/-2", "1/99999999999"})
        EXPECT_THROW(parse_shard(wrong), UsageError) << wrong;
    for (std::size_t number = 0; number < 20; ++number) {
        int held = 0;
        for (int i = 1; i <= 3; ++i) held += Shard{i, 3}.contains(number);
        EXPECT_EQ(held, 1);
    }
}

TEST(Sweep, MeasuresEachCaseOnceAndTimesAllInRounds) {
    const FakeSweep f(fresh_test_folder());
    FakeMeter meter;
    f.run(meter);
    EXPECT_EQ(meter.measured.size(), 8u);
    ASSERT_EQ(meter.timed.size(), 4u * 8);
    EXPECT_EQ(meter.timed[7], meter.timed[8]) << "the second round goes backwards";
    const OrderedJson r = f.results();
    EXPECT_EQ(r["rows"].size(), 8u);
    EXPECT_EQ(r["rounds"], 4);
    for (const OrderedJson& row : r["rows"]) {
        EXPECT_EQ(row["time"]["frames"], 12);
        EXPECT_TRUE(fs::exists(f.folder / row["picture"].get<std::string>()));
    }
    EXPECT_EQ(r["frontier"]["x"], "time.total_ms.median");
}

TEST(Sweep, RoundsEndWhenAllTimesAreStable) {
    const FakeSweep f(fresh_test_folder());
    struct Calm : FakeMeter {
        CaseTimes time(const SweepCase& c, int frames, CostCase, ShadowFrames) override {
            drift = 1;
            timed.push_back(c.id);
            return {{std::vector<double>(std::size_t(frames), 7),
                     std::vector<double>(std::size_t(frames), 1),
                     {},
                     "clock"}};
        }
    } meter;
    f.run(meter, 10'000, {.rounds = 50});
    EXPECT_EQ(meter.timed.size(), 3u * 8) << "of fewer rounds it is not known how they differ";
}

TEST(Sweep, ContinuesWithoutLoss) {
    const FakeSweep f(fresh_test_folder());
    for (const int steps : {0, 1, 5, 8, 9, 15, 16, 20, 100}) {
        const fs::path folder = f.folder / std::to_string(steps);
        FakeSweep part(folder);
        FakeMeter first, second;
        second.run_id = "second";
        part.run(first, steps);
        part.run(second);
        EXPECT_EQ(first.measured.size() + second.measured.size(), 8u) << steps;
        const OrderedJson r = part.results();
        EXPECT_EQ(r["rounds"], 4) << steps;
        EXPECT_EQ(r["finished"], 8) << steps;
        // Complete rounds count from any run; a partial round is drawn again, in one run.
        const int whole = std::max(0, std::min(steps - 8, 32)) / 8;
        EXPECT_EQ(second.timed.size(), std::size_t(4 - whole) * 8) << steps;
        for (const OrderedJson& run : r["runs"])
            EXPECT_EQ(run["ranked_rounds"], run["id"] == "first" ? whole : 4 - whole) << steps;
        const std::string before = file_bytes(folder / kJournalFile);
        FakeMeter third;
        part.run(third);
        EXPECT_TRUE(third.measured.empty() && third.timed.empty());
        EXPECT_EQ(file_bytes(folder / kJournalFile), before) << "nothing to do, nothing written";
    }
}

TEST(Sweep, TruncatedLineIsIgnored) {
    const FakeSweep f(fresh_test_folder());
    FakeMeter meter;
    f.run(meter, 3);
    const std::string text = file_bytes(f.folder / kJournalFile);
    for (std::size_t cut = 1; cut < 40; cut += 7) {
        std::ofstream(f.folder / kJournalFile, std::ios::binary) << text.substr(0, text.size() - cut);
        FakeMeter again;
        f.run(again, 0);
        const SweepState state = read_journal(f.folder);
        EXPECT_TRUE(state.cases.at(0).finished && state.cases.at(1).finished && !state.cases.at(2).finished);
        f.run(again);
        EXPECT_EQ(f.results()["finished"], 8);
    }
}

TEST(Sweep, BadLineLosesOnlyItsCase) {
    const FakeSweep f(fresh_test_folder());
    f.measure();
    const std::string text = file_bytes(f.folder / kJournalFile);
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
        lines.push_back(text.substr(at, text.find('\n', at) - at));
    const auto facts =
        std::find_if(lines.begin(), lines.end(), [](const auto& l) { return l.starts_with("{\"facts\":3"); });
    ASSERT_NE(facts, lines.end());
    const std::string good = *facts, deep = std::string(100'000, '[') + std::string(100'000, ']');
    for (const std::string& bad : {std::string("{\"facts\":3,\"error\":{\"me"), std::string("\xff\xfe\0", 3), deep,
                                   std::string("{\"facts\":3}"), std::string("[]"), std::string("{\"unknown\":1}"),
                                   "{\"facts\":800" + good.substr(10), "{\"facts\":-3" + good.substr(10)}) {
        *facts = bad;
        std::string changed;
        for (const std::string& line : lines) changed += line + "\n";
        std::ofstream(f.folder / kJournalFile, std::ios::binary) << changed;
        const SweepState state = read_journal(f.folder);
        ASSERT_EQ(state.notes.size(), 1u) << bad.substr(0, 40);
        EXPECT_NE(state.notes[0].find("line "), std::string::npos);
        EXPECT_LT(state.notes[0].size(), 500u);
        FakeMeter again;
        const SweepState mended = f.run(again, 10'000, {.rounds = 2});
        EXPECT_EQ(again.measured.size(), 1u) << "one case is measured again";
        EXPECT_EQ(again.timed.size(), 2u * 8) << "and no case beyond the plan is drawn";
        EXPECT_EQ(f.results()["finished"], 8);
    }
    *facts = "\n\n" + good;  // empty lines
    std::string changed;
    for (const std::string& line : lines) changed += line + "\n";
    std::ofstream(f.folder / kJournalFile, std::ios::binary) << changed;
    FakeMeter again;
    EXPECT_EQ(f.run(again, 10'000, {.on = false}).notes.size(), 2u);
    EXPECT_TRUE(again.measured.empty());
    // Errors name a few lines of a badly damaged journal.
    changed = lines[0] + "\n";
    for (int i = 0; i < 1000; ++i) changed += "x\n";
    std::ofstream(f.folder / kJournalFile, std::ios::binary) << changed;
    EXPECT_LT(read_journal(f.folder).notes.size(), 10u);
    // Notes are sentences of this program, not of its libraries.
    changed = lines[0] + "\n";
    for (const char* line :
         {"{\"facts\":1", "{\"facts\":1,\"error\":3}", "{\"turn\":0,\"round\":\"a\"}", "[1]", "\xff"})
        changed += line + std::string("\n");
    std::ofstream(f.folder / kJournalFile, std::ios::binary) << changed;
    const SweepState damaged = read_journal(f.folder);
    EXPECT_EQ(damaged.notes.size(), 5u);
    for (const std::string& note : damaged.notes)
        for (const char* foreign : {"json.exception", "parse", "type must be", "literal", "syntax", "cannot use"})
            EXPECT_EQ(note.find(foreign), note.npos) << note;
    EXPECT_EQ(test::lacking(damaged.notes[0], {"line 2 is left out: it is cut short or damaged"}), "");
    EXPECT_EQ(test::lacking(damaged.notes[1], {"line 3 is left out: a number or a text is missing"}), "");
}

TEST(Sweep, ImpossibleNumbersAreMeasuredAgain) {
    const FakeSweep f(fresh_test_folder());
    f.measure();
    const std::string text = file_bytes(f.folder / kJournalFile);
    const std::size_t at = text.find("{\"facts\":3"), end = text.find('\n', at);
    ASSERT_NE(at, text.npos);
    const auto good_line = nlohmann::ordered_json::parse(text.substr(at, end - at));
    const auto with = [&](const nlohmann::ordered_json& line) {
        std::ofstream(f.folder / kJournalFile, std::ios::binary) << text.substr(0, at) << line.dump() << '\n'
                                                                 << text.substr(end + 1);
        return read_journal(f.folder);
    };
    for (const nlohmann::ordered_json& value : {nlohmann::ordered_json(-5), nlohmann::ordered_json(1e308),
                                                nlohmann::ordered_json(1.01), nlohmann::ordered_json()}) {
        auto line = good_line;
        line["error"]["mae"] = value;
        line["error"]["pixels"]["counted"] = 100;
        EXPECT_EQ(with(line).notes.size(), 1u) << value;
        const FakeMeter again = f.measure();
        EXPECT_EQ(again.measured.size(), 1u) << value;
    }
    auto line = good_line;
    line["error"]["signed_mean"] = -0.5;
    EXPECT_TRUE(with(line).notes.empty()) << "which may be negative";
    // The first of two contradicting lines of one case counts.
    std::ofstream(f.folder / kJournalFile, std::ios::binary) << text << line.dump() << '\n';
    const SweepState state = read_journal(f.folder);
    ASSERT_EQ(state.notes.size(), 1u);
    EXPECT_NE(state.notes[0].find("contradicts itself in case 3: signed_mean"), std::string::npos) << state.notes[0];
    EXPECT_EQ(state.cases.at(3).error.metrics.signed_mean, good_line["error"]["signed_mean"].get<double>());
}

TEST(Sweep, JournalMayBeDamagedAtItsStart) {
    const FakeSweep f(fresh_test_folder());
    f.measure();
    const std::string text = file_bytes(f.folder / kJournalFile);
    const auto write = [&](const std::string& changed) {
        std::ofstream(f.folder / kJournalFile, std::ios::binary) << changed;
    };
    for (const char* before : {"\n", "x\n", "{\"facts\":3}\n"}) {
        write(before + text);
        require_sweep_folder(f.folder);
        FakeMeter again;
        EXPECT_EQ(f.run(again, 10'000, {.on = false}).notes.size(), 1u) << before;
        EXPECT_TRUE(again.measured.empty()) << before;
    }
    // The axes are lost, but the file is recognised as a sweep's.
    write("x" + text);
    EXPECT_THROW(read_journal(f.folder), Error);
    remove_sweep_files(f.folder);
    EXPECT_FALSE(std::filesystem::exists(f.folder / kJournalFile));
    write("one\ntwo\n");
    EXPECT_THROW(remove_sweep_files(f.folder), Error) << "another program's file of that name";
}

TEST(Sweep, EmptyPictureCountsAsMissing) {
    const FakeSweep f(fresh_test_folder());
    std::filesystem::create_directories(f.folder / "pictures");
    EXPECT_TRUE(lacks_pictures(f.folder, 0));
    std::ofstream(f.folder / picture_path(0)) << "x";
    std::ofstream(f.folder / artefacts_path(0)) << "x";
    EXPECT_FALSE(lacks_pictures(f.folder, 0));
    std::ofstream(f.folder / picture_path(0)).close();
    EXPECT_TRUE(lacks_pictures(f.folder, 0));
    std::filesystem::remove_all(f.folder / "pictures");
    std::ofstream(f.folder / "pictures") << "a file";
    EXPECT_THROW(make_picture_folder(f.folder), Error);
}

TEST(Sweep, ReducedMapIsListedAtItsActualSize) {
    const FakeSweep f(fresh_test_folder());
    FakeMeter meter;
    meter.max_resolution = 512;
    f.run(meter, 10'000, {.on = false});
    const SweepResults results = f.measured();
    std::size_t smaller = 0;
    for (const SweepRow& row : results.rows) {
        EXPECT_LE(std::stoi(row.settings[0].second), 512);
        const bool noted = std::ranges::find(row.notes, "smaller, for reasons") != row.notes.end();
        EXPECT_TRUE(!noted || row.settings[0].second == "512");
        smaller += noted;
    }
    EXPECT_EQ(smaller, 4u);
    const std::string csv = results_csv(results);
    EXPECT_EQ(csv.find("1024"), std::string::npos) << csv;
    EXPECT_NE(csv.substr(0, csv.find('\n')).find(",failed,notes"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",\"a note; smaller, for reasons\"\n"), std::string::npos) << csv;
    FakeMeter again;
    f.run(again);
    EXPECT_TRUE(again.measured.empty()) << "the axis that was asked for is still the sweep's";
}

TEST(Sweep, MissingPicturesAreDrawnAgain) {
    const FakeSweep f(fresh_test_folder());
    f.measure();
    const OrderedJson before = f.results();
    fs::remove_all(f.folder / "pictures");
    const FakeMeter again = f.measure();
    EXPECT_EQ(again.measured.size(), 8u);
    EXPECT_FALSE(lacks_pictures(f.folder, 7));
    EXPECT_EQ(f.results()["rows"], before["rows"]);
    fs::remove(f.folder / artefacts_path(5));
    FakeMeter one;
    one.fails_at_resolution = 1024;
    f.run(one, 10'000, {.on = false});
    EXPECT_EQ(one.measured, (std::vector<std::string>{f.plan.cases[5].id}));
    EXPECT_EQ(f.results()["finished"], 8) << "a picture that cannot be drawn again takes no number away";
}

TEST(Sweep, ForeignFilesAreNeitherReplacedNorRemoved) {
    const fs::path root = fresh_test_folder();
    for (const char* name : {"results.json", "report.html", "base.json", "journal.jsonl", "pictures/0003.jpg"}) {
        const fs::path folder = root / fs::path(name).stem(), file = folder / name;
        fs::create_directories(file.parent_path());
        std::ofstream(file) << "mine";
        const std::string said = std::string("holds ") + name;
        EXPECT_TRUE(test::fails_with([&] { require_sweep_folder(folder); }, {said})) << name;
        EXPECT_TRUE(test::fails_with([&] { remove_sweep_files(folder); }, {said})) << name;
        EXPECT_EQ(file_bytes(file), "mine") << name;
    }
    // A foreign file next to a sweep.
    const FakeSweep f(root / "ours");
    f.measure();
    for (const char* name : {"pictures/2026-holiday.jpg", "pictures/007.jpg", "notes.txt", "pictures/0001-mine.png"})
        std::ofstream(f.folder / name) << "mine";
    remove_sweep_files(f.folder);
    EXPECT_FALSE(fs::exists(f.folder / kJournalFile));
    EXPECT_TRUE(lacks_pictures(f.folder, 0));
    for (const char* name : {"pictures/2026-holiday.jpg", "pictures/007.jpg", "notes.txt", "pictures/0001-mine.png"})
        EXPECT_EQ(file_bytes(f.folder / name), "mine") << name;
    // A journal killed in its first line is recognised; its sweep starts again.
    const FakeSweep killed(root / "killed");
    fs::create_directories(killed.folder);
    std::ofstream(killed.folder / kJournalFile) << "{\"format\":\"shadow-insp";
    EXPECT_NO_THROW(require_sweep_folder(killed.folder));
    const FakeMeter first = killed.measure();
    EXPECT_EQ(first.measured.size(), 8u);
}

TEST(Sweep, OtherArgumentsAreRefused) {
    FakeSweep f(fresh_test_folder());
    FakeMeter meter;
    f.run(meter, 2);
    const auto refused = [&](auto change, std::string_view reason) {
        FakeSweep other = f;
        change(other);
        return test::fails_with([&] { other.run(meter, 1); }, {reason});
    };
    EXPECT_TRUE(refused([](FakeSweep& o) { o.spec.width = 9; }, "--size 8x8 there, 9x8 here"));
    EXPECT_TRUE(refused([](FakeSweep& o) { o.spec.base.bias.slope = 2; }, "bias.slope: the default there, 2 here"));
    EXPECT_TRUE(refused([](FakeSweep& o) { o.spec.axes.pop_back(); }, "filter.kernel=hard,pcf3 there"));
    EXPECT_TRUE(refused([](FakeSweep& o) { o.spec.shard = {1, 2}; }, "--shard 1/1 there, 1/2 here"));
    EXPECT_TRUE(refused([](FakeSweep& o) { o.spec.scene_content = 5; }, "stage has changed"));
    f.spec.scene = "boxes";
    EXPECT_TRUE(refused([](FakeSweep& o) { o.spec.scene_content = 5; }, "boxes here"));
    f.spec.scene = "stage";
    EXPECT_NO_THROW(f.run(meter, 1));
}

TEST(Sweep, OneProcessAtATime) {
    const FakeSweep f(fresh_test_folder());
    const Journal journal(f.folder, f.spec_text(), plan_key(f.plan));
    EXPECT_THROW(Journal(f.folder, f.spec_text(), plan_key(f.plan)), Error);
}

TEST(Sweep, FailingCaseIsARowWithItsError) {
    const FakeSweep f(fresh_test_folder());
    FakeMeter meter;
    meter.fails_at_resolution = 512;
    f.run(meter);
    OrderedJson r = f.results();
    EXPECT_EQ(r["finished"], 6);
    EXPECT_EQ(r["failed"], 2);
    EXPECT_EQ(r["rows"][2]["failed"], "no memory for; this map");
    EXPECT_TRUE(r["rows"][2]["error"].is_null());
    EXPECT_EQ(r["rounds"], 4) << "the others have their times";
    for (const OrderedJson& n : r["frontier"]["cases"]) EXPECT_TRUE(n != 2 && n != 3);
    EXPECT_NE(results_csv(f.measured()).find(",false,no memory for; this map,\n"), std::string::npos);
    FakeMeter again;
    f.run(again);
    EXPECT_TRUE(again.measured.empty()) << "a failure is a result";
    f.run(again, 10'000, {.rounds = 4}, true);
    EXPECT_EQ(again.measured.size(), 2u);
    EXPECT_EQ(f.results()["failed"], 0);
}

TEST(Sweep, CrashingCaseFails) {
    const FakeSweep f(fresh_test_folder());
    FakeMeter meter;
    f.run(meter, 2);
    for (int i = 0; i < kMaxBegins; ++i) Journal(f.folder, f.spec_text(), plan_key(f.plan)).add(begin_line(2));
    f.run(meter, 10'000, {.on = false});
    EXPECT_EQ(meter.measured.size(), 7u);
    EXPECT_NE(f.results()["rows"][2]["failed"].get<std::string>().find("the program ended"), std::string::npos);
}

TEST(Sweep, CancelledCaseIsMeasuredLater) {
    /// Meter whose measurement of one case is cancelled.
    struct CancelledMeter : FakeMeter {
        DrawnCase facts(const SweepCase& c) override {
            DrawnCase made = FakeMeter::facts(c);
            if (measured.size() == 3) throw Cancelled();
            return made;
        }
    };
    const FakeSweep f(fresh_test_folder());
    FakeMeter first;
    f.run(first, 2);
    for (int i = 0; i <= kMaxBegins; ++i) {
        CancelledMeter cancelled;
        cancelled.measured.resize(2);
        EXPECT_THROW(f.run(cancelled), Cancelled);
        EXPECT_EQ(f.results()["failed"], 0);
        EXPECT_EQ(f.results()["finished"], 2);
    }
    FakeMeter meter;
    f.run(meter, 10'000, {.on = false});
    EXPECT_EQ(meter.measured.size(), 6u);
    EXPECT_EQ(f.results()["failed"], 0) << "a case that was cancelled more than kMaxBegins times has not crashed";
}

TEST(Sweep, SettingsOfACaseAloneAreKeptAndInItsCommand) {
    /// Meter whose bias depends on the case's map, as that of an engine profile does.
    struct ProfileMeter : FakeMeter {
        DrawnCase facts(const SweepCase& c) override {
            DrawnCase made = FakeMeter::facts(c);
            if (c.settings.map.resolution < 512)
                made.own_settings = {{"bias.normal", "0.25"}, {"bias.kind", "adaptive"}};
            return made;
        }
    } meter;
    const FakeSweep f(fresh_test_folder());
    f.run(meter, 10'000, {.on = false});
    const OrderedJson r = f.results();
    EXPECT_EQ(r["rows"][0]["own_settings"], (OrderedJson{{"bias.normal", "0.25"}, {"bias.kind", "adaptive"}}));
    EXPECT_FALSE(r["rows"][2].contains("own_settings"));
    const std::string html = report_html(r, f.folder);
    const std::string begin =
        "shadow-inspector edit stage --preset " + shell_quoted((f.folder / kBasePreset).string()) + " --set ";
    EXPECT_NE(html.find(begin + "map.resolution=256 --set filter.kernel=hard --set bias.normal=0.25 --set "
                                "bias.kind=adaptive --set bias.constant="),
              std::string::npos)
        << "the base's other amounts stay";
    EXPECT_NE(html.find(begin + "map.resolution=512 --set filter.kernel=hard\""), std::string::npos);
    // Merging keeps them. A line with an unknown setting is left out.
    const SweepState state = read_journal(f.folder);
    EXPECT_EQ(merge_sweeps({{"a", state}, {"b", state}}).cases.at(0).own_settings, state.cases.at(0).own_settings);
    OrderedJson line = facts_line(0, state.cases.at(0));
    line["own_settings"] = {{"no.setting", "1"}};
    SweepState other;
    EXPECT_THROW(other.apply(line), Error);
    EXPECT_TRUE(other.cases.empty());
}

TEST(Sweep, TimesOfDifferentMachinesAreNotMixed) {
    const FakeSweep f(fresh_test_folder());
    FakeMeter here, there;
    f.run(here, 8 + 8);
    there.machine = "other";
    there.run_id = "elsewhere";
    there.drift = 1000;
    f.run(there, 10'000, {.rounds = 3});
    const OrderedJson r = f.results();
    EXPECT_EQ(r["rounds"], 3);
    for (const OrderedJson& row : r["rows"]) EXPECT_GT(row["time"]["total_ms"]["low"], 1000);
}

TEST(Sweep, ErrorsOfAnotherDefinitionAreNotMixed) {
    const fs::path folder = fresh_test_folder();
    const FakeSweep old(folder / "old");
    FakeMeter meter;
    const SweepState state = old.run(meter, 2);
    const OrderedJson results = old.results();
    for (const OrderedJson& row : results["rows"]) EXPECT_EQ(number_at(row, "error.meaning"), kErrorMeaning);
    const fs::path file = old.folder / kJournalFile;
    const std::string text = file_bytes(file);
    const std::string number = "\"meaning\":" + std::to_string(kErrorMeaning);
    const auto replaced = [&](std::string t, const std::string& by, bool all) {
        for (auto at = t.find(number); at != std::string::npos; at = all ? t.find(number, at + 1) : std::string::npos)
            t.replace(at, number.size(), by);
        return t;
    };
    // A journal without a number, with another one, and with both.
    for (const std::string& changed : {replaced(text, "\"other\":0", true), replaced(text, "\"meaning\":7", true),
                                       replaced(text, "\"meaning\":1", false)}) {
        ASSERT_NE(changed, text);
        std::ofstream(file, std::ios::binary) << changed;
        const bool seven = changed.find("\"meaning\":7") != std::string::npos;
        const std::string place = file.string() + ": line ", meaning = seven ? "meaning 7" : "meaning 1";
        EXPECT_TRUE(test::fails_with([&] { old.run(meter, 1); }, {place, meaning, "--fresh"}));
        EXPECT_TRUE(test::fails_with([&] { read_journal(old.folder); }, {place, meaning, "--fresh"}));
        EXPECT_EQ(file_bytes(file), changed) << "left as it is";
    }
    SweepState mixed = state;
    OrderedJson line = facts_line(5, state.cases.begin()->second);
    line["error"].erase("meaning");
    EXPECT_THROW(mixed.apply(line), Error);
    EXPECT_FALSE(mixed.cases.contains(5));
}

TEST(Merge, ShardsMergeIntoTheWholeSweep) {
    const fs::path folder = fresh_test_folder();
    FakeSweep whole(folder / "whole");
    FakeMeter meter = whole.measure();
    std::vector<std::pair<std::string, SweepState>> parts;
    for (int i = 1; i <= 3; ++i) {
        FakeSweep shard(folder / std::to_string(i));
        shard.spec.shard = {i, 3};
        const FakeMeter m = shard.measure();
        EXPECT_EQ(m.measured.size(), i == 3 ? 2u : 3u);
        parts.emplace_back(std::to_string(i), read_journal(shard.folder));
    }
    const SweepState merged = merge_sweeps(parts);
    EXPECT_TRUE(missing_cases(merged, whole.plan).empty());
    OrderedJson a = results_json(sweep_results(merged, whole.plan)), b = whole.results();
    a.erase("runs");
    b.erase("runs");
    EXPECT_EQ(a, b);
    parts.erase(parts.begin() + 1);
    EXPECT_EQ(missing_cases(merge_sweeps(parts), whole.plan), (std::vector<std::size_t>{1, 4, 7}));
    FakeSweep other(folder / "other");
    other.spec.width = 9;
    other.run(meter, 1);
    parts.emplace_back("other", read_journal(other.folder));
    EXPECT_THROW(merge_sweeps(parts), Error);
}

TEST(Merge, ContradictingPartsAreNamed) {
    const fs::path root = fresh_test_folder();
    std::vector<std::pair<std::string, SweepState>> parts;
    for (const char* name : {"one", "two", "three"}) {
        FakeSweep part(root / name);
        part.measure();
        parts.emplace_back(name, read_journal(part.folder));
    }
    EXPECT_TRUE(merge_sweeps(parts).notes.empty()) << "the same work done thrice";
    parts[1].second.cases.at(4).error.metrics.mae = 7;
    parts[2].second.cases.at(2).cost.map_texels = 7;
    const SweepState merged = merge_sweeps(parts);
    ASSERT_EQ(merged.notes.size(), 2u);
    EXPECT_NE(merged.notes[0].find("one and two contradict each other in case 4: mae 0."), std::string::npos)
        << merged.notes[0];
    EXPECT_NE(merged.notes[1].find("one and three contradict each other in case 2: map_texels"), std::string::npos)
        << merged.notes[1];
    EXPECT_NE(merged.cases.at(4).error.metrics.mae, 7) << "the first counts";
    for (auto& [number, c] : parts[1].second.cases) c.error.metrics.mae = 7;
    EXPECT_LT(merge_sweeps(parts).notes.size(), 8u);
}

TEST(Merge, MergedSweepIsTimedByContinuation) {
    const fs::path folder = fresh_test_folder();
    std::vector<std::pair<std::string, SweepState>> parts;
    for (int i = 1; i <= 2; ++i) {
        FakeSweep shard(folder / std::to_string(i));
        shard.spec.shard = {i, 2};
        shard.measure();
        parts.emplace_back("", read_journal(shard.folder));
    }
    FakeSweep whole(folder / "whole");
    {
        Journal journal(whole.folder, whole.spec_text(), plan_key(whole.plan));
        journal.add(missing_lines(journal.state(), merge_sweeps(parts)));
        EXPECT_TRUE(missing_lines(journal.state(), merge_sweeps(parts)).empty());
    }
    for (const char* shard : {"1", "2"}) copy_pictures(folder / shard, whole.folder);
    FakeMeter meter;
    whole.run(meter);
    EXPECT_TRUE(meter.measured.empty());
    EXPECT_EQ(whole.results()["rounds"], 4);
}

TEST(Results, SpecsSurviveTheJournal) {
    FakeSweep f(fresh_test_folder());
    f.spec.base.bias.slope = 1.5;
    f.spec.base.light_count = 2;
    f.spec.base.lights[1].azimuth = 77;
    f.spec.scene = "a \"quoted\", name</script>\n";
    f.spec.scene_content = 0xfedcba9876543210;
    f.spec.shard = {2, 3};
    const SweepSpec again = spec_from_json(OrderedJson::parse(f.spec_text().dump()));
    EXPECT_EQ(spec_json(again), f.spec_text());
    EXPECT_EQ(again.base, f.spec.base);
    EXPECT_EQ(plan_key(plan_sweep(again.base, again.axes)), plan_key(plan_sweep(f.spec.base, f.axes)));
    EXPECT_THROW(spec_from_json({{"scene", 1}}), Error);
}

TEST(Results, ContentDecidesWhetherScenesAreEqual) {
    const Scene stage = load_scene("stage"), again = load_scene("stage");
    EXPECT_NE(stage.id, again.id);
    EXPECT_EQ(scene_content_key(stage), scene_content_key(again));
    Scene moved = stage;
    moved.objects[0].world[3].x += 1e-9;
    EXPECT_NE(scene_content_key(moved), scene_content_key(stage));
    Scene seen = stage;
    seen.cameras.emplace_back();
    EXPECT_NE(scene_content_key(seen), scene_content_key(stage));
    Scene wider = seen;
    wider.cameras.back().fov_y_deg += 1;
    EXPECT_NE(scene_content_key(wider), scene_content_key(seen));
}

TEST(Results, ContentOfASceneHasItsOtherPoses) {
    const Scene stage = load_scene("stage");
    const auto key = [&](float end, float vertex, bool moves) {
        Scene scene = stage;
        auto rig = std::make_shared<Rig>();
        if (moves) {
            AnimationChannel channel;
            channel.times_s = {0, 1};
            channel.values = {0, 0, 0, end, 0, 0};
            rig->animations.emplace_back().channels.push_back(channel);
        }
        scene.rig = rig;
        auto source = std::make_shared<DeformSource>();
        source->positions.emplace_back(vertex, 0.0f, 0.0f);
        auto deformer = std::make_shared<Deformer>();
        deformer->source = source;
        scene.meshes[0].deformer = deformer;
        return scene_content_key(scene);
    };
    EXPECT_EQ(key(1, 2, true), key(1, 2, true));
    EXPECT_NE(key(3, 2, true), key(1, 2, true)) << "keyframes";
    EXPECT_NE(key(1, 3, true), key(1, 2, true)) << "vertices before they are deformed";
    EXPECT_EQ(key(1, 2, false), scene_content_key(stage)) << "nothing moves";
}

TEST(Results, OtherShadowMapsOfABundleAreAnotherSweep) {
    const fs::path path = fresh_test_folder() / "a.bundle";
    LightView view;
    view.curve = {.perspective = false, .near = 0, .far = 20, .convention = {}, .warp = {}};
    view.set_half_extents(glm::dvec2(4));
    Bundle bundle;
    BundleMap& map = bundle.lights.emplace_back().maps.emplace_back();
    map.image.file = "a.pfm";
    map.depth.convention = view.curve.convention;
    map.clip.clip_from_world = view.clip_from_relative(glm::dvec3(0));
    // Sizes differ, so that a file written at once after another one is another file.
    const auto write = [&](float depth, const std::string& scale) {
        std::string image = "Pf\n2 2\n" + scale + "\n";
        for (int i = 0; i < 4; ++i) image.append(reinterpret_cast<const char*>(&depth), sizeof depth);
        fs::remove_all(path);
        write_bundle_files({{"frame.json", format_bundle(bundle)}, {"a.pfm", image}}, path);
    };
    const Scene scene = load_scene("plane");
    Settings settings;
    const auto spec = [&] { return spec_json(sweep_spec("plane", scene, settings, {}, 8, 8)); };
    EXPECT_FALSE(spec().contains("maps")) << "the settings name no bundle";
    settings.map.bundle = path.string();
    write(0.25f, "-1.0");
    const OrderedJson first = spec();
    EXPECT_EQ(spec_json(spec_from_json(first)), first);
    write(0.25f, "-1.00");
    EXPECT_EQ(spec_difference(first, spec()), "") << "the same maps, written again";
    write(0.5f, "-1.000");
    EXPECT_EQ(spec_difference(first, spec()), "the shadow maps of " + path.string() + " have changed since");
}

TEST(Results, NumbersSurviveTheJournalToTheLastDigit) {
    // Every number differs, some are unknown: read values equal written ones.
    CaseState c;
    double v = 0.1;
    for (const Metric& m : metrics())
        if (m.member) c.error.metrics.*m.member = v /= 1.7;
    c.error.metrics.boundary_px_max = std::numeric_limits<double>::quiet_NaN();
    c.error.noise = 1 / 3.0;
    std::size_t pixels = 7;
    for (std::size_t& p : c.error.metrics.pixels) p = ++pixels;
    for (std::size_t& a : c.error.metrics.artefacts) a = ++pixels;
    c.cost = {.taps_per_pixel = 2.5,
              .map_texels = 3,
              .map_bytes = 1ull << 40,
              .bytes_touched = 5,
              .draws = 6,
              .triangles = 7};
    const std::string text = facts_line(4, c).dump();
    SweepState state;
    state.apply(OrderedJson::parse(text));
    const CaseState& read = state.cases.at(4);
    EXPECT_EQ(facts_line(4, read).dump(), text);
    EXPECT_EQ(read.error.metrics.lost_false_light, c.error.metrics.lost_false_light);
    EXPECT_TRUE(std::isnan(read.error.metrics.boundary_px_max));
    EXPECT_EQ(read.error.metrics.pixels, c.error.metrics.pixels);
    EXPECT_EQ(read.error.metrics.artefacts, c.error.metrics.artefacts);
    EXPECT_EQ(read.error.metrics.counted, c.error.metrics.pixels[0]);
    EXPECT_EQ(read.cost.map_bytes, c.cost.map_bytes);
    EXPECT_EQ(read.error.noise, c.error.noise);
    // A column maps typed numbers to their key in results.json.
    TimeSamples samples;
    for (const double ms : {3.0, 4.0, 5.0, 9.0}) {
        samples.total_ms.push_back(ms);
        samples.maps_ms.push_back(ms / 4);
    }
    ShadowTime shadow =
        summarise_shadow({.moving_ms = {4, 5, 6}, .still_ms = {1, 2, 3}, .forced_more_ms = {5, 6, 7}, .bursts = {}});
    shadow.of_base = 1.5;
    const CaseNumbers numbers{.error = c.error, .cost = c.cost, .time = summarise_times(samples), .shadow = shadow};
    const OrderedJson row = {{"error", error_json(c.error.metrics, c.error.noise)},
                             {"cost", cost_json(c.cost)},
                             {"time", time_json(*numbers.time)},
                             {"shadow", shadow_json(shadow)}};
    std::size_t compared = 0;
    for (const Column& column : columns()) {
        const double said = column.value(numbers), held = number_at(row, column.key);
        EXPECT_TRUE(said == held || (std::isnan(said) && std::isnan(held))) << column.key << " " << said << " " << held;
        compared += std::isfinite(held);
        if (column.noise.empty()) continue;
        EXPECT_EQ(noise_of(column, numbers), number_at(row, column.noise)) << column.key;
    }
    EXPECT_EQ(compared, columns().size() - 1);
}

TEST(Sweep, TimesOfOtherFramesAreNeverMixed) {
    const FakeSweep f(fresh_test_folder());
    FakeMeter forced, camera;
    camera.run_id = "second";
    f.run(forced, 10'000, {.cost = CostCase::Forced, .rounds = 4});
    EXPECT_EQ(f.results()["timed"], "forced");
    f.run(camera, 10'000, {.cost = CostCase::Camera, .rounds = 2});
    EXPECT_TRUE(camera.measured.empty()) << "errors and costs are the same";
    EXPECT_EQ(camera.timed.size(), 2u * 8) << "and times begin anew";
    const OrderedJson r = f.results();
    EXPECT_EQ(r["timed"], "camera");
    EXPECT_EQ(r["rounds"], 2) << "those that were taken last, though they are fewer";
    for (const OrderedJson& row : r["rows"]) {
        EXPECT_EQ(row["time"]["timed"], "camera");
        EXPECT_EQ(row["time"]["frames"], 6);
    }
    EXPECT_EQ(r["runs"][0]["timed"], "forced");
    EXPECT_EQ(r["runs"][0]["ranked_rounds"], 0);
    EXPECT_NE(frontier_text(f.measured()).find("while the camera moves"), std::string::npos);
}

TEST(Sweep, JournalsWithoutFrameKindCountAsForced) {
    const FakeSweep f(fresh_test_folder());
    FakeMeter forced;
    f.run(forced, 10'000, {.cost = CostCase::Forced, .rounds = 4});
    std::string text;
    {
        std::ifstream in(f.folder / kJournalFile);
        for (std::string line; std::getline(in, line);) {
            OrderedJson json = OrderedJson::parse(line);
            if (json.contains("run") && json["run"].is_object()) json["run"].erase("cost");
            text += json.dump() + "\n";
        }
    }
    std::ofstream(f.folder / kJournalFile) << text;
    EXPECT_EQ(f.results()["timed"], "forced");
    FakeMeter light;
    light.run_id = "second";
    f.run(light, 10'000, {.cost = CostCase::Light, .rounds = 1});
    EXPECT_EQ(f.results()["timed"], "light");
    EXPECT_EQ(f.results()["rounds"], 1);
}

/// Meter whose shadows take 1 ms per 256 texels, a quarter of it under a still light, with noise of 2 %.
struct ShadowMeter : FakeMeter {
    CaseTimes time(const SweepCase& c, int frames, CostCase cost, ShadowFrames which) override {
        CaseTimes times = FakeMeter::time(c, frames, cost, which);
        for (int i = 0; i < frames; ++i) {
            const double ms = c.settings.map.resolution / 256.0 * (1 + 0.02 * (i % 3 - 1));
            times.shadow.moving_ms.push_back(ms);
            times.shadow.still_ms.push_back(0.25 * ms);
            times.shadow.forced_more_ms.push_back(2 * c.settings.map.resolution / 256.0);
        }
        return times;
    }
};

TEST(Sweep, ShadowTimesAndTheBaseSurviveTheJournal) {
    for (const int steps : {0, 9, 17, 100}) {
        const FakeSweep f(fresh_test_folder());
        ShadowMeter first, second;
        second.run_id = "second";
        f.run(first, steps);
        f.run(second);
        const OrderedJson r = f.results();
        EXPECT_EQ(r["frontier"]["x"], kMovingShadowColumn) << steps;
        EXPECT_EQ(r["timed"], "light") << "frames in which the light moves are the default";
        for (const OrderedJson& row : r["rows"]) {
            const double n = std::stod(row["settings"]["map.resolution"].get<std::string>());
            EXPECT_NEAR(number_at(row, "shadow.moving_ms.median"), n / 256, 1e-9);
            EXPECT_NEAR(number_at(row, "shadow.still_ms.median"), n / 1024, 1e-9);
            EXPECT_NEAR(number_at(row, "shadow.forced_ms.median"), 3 * n / 256, 1e-9);
            EXPECT_NEAR(number_at(row, "shadow.of_base"), n / 1024, 1e-9);
            EXPECT_EQ(row["shadow"]["moving_ms"]["below_noise"], false);
        }
        const int base = r["base"]["case"];
        EXPECT_EQ(r["rows"][std::size_t(base)]["settings"],
                  (OrderedJson{{"map.resolution", "1024"}, {"filter.kernel", "hard"}}));
        EXPECT_NE(results_csv(f.measured())
                      .find(",shadow.moving_ms.median,shadow.still_ms.median,shadow.forced_ms.median,shadow.of_base,"),
                  std::string::npos);
    }
}

TEST(Sweep, LaterRoundsTimeTheMovingLightAlone) {
    struct : ShadowMeter {
        std::map<std::string, std::vector<ShadowFrames>> which_of;
        CaseTimes time(const SweepCase& c, int frames, CostCase cost, ShadowFrames which) override {
            which_of[c.id].push_back(which);
            CaseTimes times = ShadowMeter::time(c, frames, cost, which);
            if (which == ShadowFrames::MovingLight) times.shadow.still_ms = times.shadow.forced_more_ms = {};
            return times;
        }
    } meter;
    // Frame times drift, so that no round is the last before the limit.
    const auto all_of = [&](const SweepTiming& timing) {
        const FakeSweep f(fresh_test_folder());
        meter.which_of.clear();
        f.run(meter, 10'000, timing);
        const ShadowTime shadow = f.measured().rows.at(0).numbers.shadow.value();
        EXPECT_EQ(shadow.moving_ms.samples, timing.rounds * timing.frames);
        const auto& which = meter.which_of.begin()->second;
        EXPECT_EQ(which.size(), std::size_t(timing.rounds));
        const auto all = std::ranges::count(which, ShadowFrames::All);
        EXPECT_EQ(std::ranges::find(which, ShadowFrames::MovingLight) - which.begin(), all) << "the first rounds";
        EXPECT_EQ(shadow.still_ms.samples, all * timing.frames);
        EXPECT_EQ(shadow.still_ms.bursts, all);
        return all;
    };
    EXPECT_EQ(all_of({.rounds = 12, .frames = 3}), 4) << "10 pairs, in whole rounds";
    EXPECT_EQ(all_of({.rounds = 12, .frames = 1}), 5) << "the first rounds draw two pairs";
    EXPECT_EQ(all_of({.rounds = 6, .frames = 20}), 3) << "noise needs three rounds";
    EXPECT_EQ(all_of({.cost = CostCase::Camera, .rounds = 12, .frames = 3}), 12) << "the still light is ranked";
}

TEST(Sweep, ShadowTimesAreFreeOfTheMachinesSpeedInEachRound) {
    struct : ShadowMeter {
        std::size_t cases = 0;
        CaseTimes time(const SweepCase& c, int frames, CostCase cost, ShadowFrames which) override {
            CaseTimes times = ShadowMeter::time(c, frames, cost, which);
            const bool slow = (timed.size() - 1) / cases % 3 == 1;  // every third round
            for (auto* of : {&times.shadow.moving_ms, &times.shadow.still_ms, &times.shadow.forced_more_ms})
                for (double& ms : *of) ms *= slow ? 1.6 : 1;
            return times;
        }
    } meter;
    const auto noise = [&](FakeSweep& f) {
        meter.timed.clear();
        meter.cases = f.plan.cases.size();
        f.run(meter, 10'000, {.rounds = 9, .frames = 1});
        const SweepResults results = f.measured();
        for (const SweepRow& row : results.rows) {
            const ShadowTime shadow = row.numbers.shadow.value();
            EXPECT_NEAR(shadow.moving_ms.median / shadow.still_ms.median, 4, 1e-9);
        }
        return results.rows.at(0).numbers.shadow->moving_ms.relative();
    };
    FakeSweep eight(fresh_test_folder());
    EXPECT_LT(noise(eight), 1e-9);
    FakeSweep four(fresh_test_folder());
    four.axes = {parse_axis("map.resolution=256:2048:*2"), parse_axis("filter.kernel=hard")};
    four.plan = plan_sweep(Settings{}, four.axes);
    four.spec.axes = four.axes;
    EXPECT_GT(noise(four), 0.1) << "few cases say little of the machine";
}

TEST(Sweep, BaseOutsideTheCasesIsTimedInTheSameRounds) {
    FakeSweep f(fresh_test_folder());
    f.axes = {parse_axis("map.resolution=256,512"), parse_axis("filter.kernel=pcf3")};
    f.plan = plan_sweep(Settings{}, f.axes);
    f.spec.axes = f.axes;
    ShadowMeter first, second;
    second.run_id = "second";
    f.run(first, 2 + 3 + 2);
    f.run(second);
    EXPECT_EQ(std::ranges::count(first.timed, "filter.kernel=hard map.resolution=1024"), 2) << "each round has it once";
    EXPECT_EQ(std::ranges::count(second.timed, "filter.kernel=hard map.resolution=1024"), 3);
    const OrderedJson r = f.results();
    EXPECT_EQ(r["rows"].size(), 2u) << "the base is no case";
    EXPECT_TRUE(r["base"]["case"].is_null());
    EXPECT_NEAR(number_at(r["base"], "shadow.moving_ms.median"), 4, 1e-9);
    EXPECT_NEAR(number_at(r["rows"][0], "shadow.of_base"), 0.25, 1e-9);
    EXPECT_EQ(r["frontier"]["best"][0]["of_base"], 1);
    EXPECT_EQ(r["frontier"]["best"][0]["case"], 1) << "both cost less than the base";
    // Merging repeated runs keeps the base's turns.
    const SweepState state = read_journal(f.folder);
    const SweepState merged = merge_sweeps({{"a", state}, {"b", state}});
    EXPECT_EQ(merged.base_turns.size(), state.base_turns.size());
    SweepState empty;
    empty.spec = state.spec;
    const std::vector<OrderedJson> lines = missing_lines(empty, state);
    EXPECT_EQ(std::ranges::count_if(lines, [](const OrderedJson& l) { return l.contains("base_turn"); }),
              std::ptrdiff_t(state.base_turns.size()));
}

TEST(Sweep, TimesBelowTheirNoiseAreBoundsWithoutARatio) {
    const FakeSweep f(fresh_test_folder());
    struct : ShadowMeter {
        CaseTimes time(const SweepCase& c, int frames, CostCase cost, ShadowFrames which) override {
            CaseTimes times = ShadowMeter::time(c, frames, cost, which);
            if (c.settings.map.resolution == 256)
                for (std::size_t i = 0; i < times.shadow.moving_ms.size(); ++i)
                    times.shadow.moving_ms[i] = i % 2 ? -0.75 : 0.5;
            return times;
        }
    } meter;
    f.run(meter);
    const OrderedJson r = f.results();
    const OrderedJson& row = r["rows"][0];
    EXPECT_EQ(row["shadow"]["moving_ms"]["below_noise"], true);
    EXPECT_TRUE(row["shadow"]["of_base"].is_null());
    const std::string text = frontier_text(f.measured());
    EXPECT_NE(text.find("< "), std::string::npos) << text;
    for (const OrderedJson& step : r["frontier"]["steps"])
        EXPECT_TRUE((step["from"] != 0 && step["to"] != 0) || step["cost_factor"].is_null());
}

TEST(Columns, ArePlottedWithLessAsBetter) {
    const OrderedJson row = {{"iou", 0.9}, {"signed_mean", -0.25}, {"mae", nullptr}, {"noise", 0.125}};
    const CaseNumbers numbers{.error = CaseErrors{error_from_json(row), number_or_nan(row, "noise")}};
    EXPECT_NEAR(plotted_value(*find_column("error.iou"), numbers), 0.1, 1e-12);
    EXPECT_EQ(plotted_value(*find_column("error.signed_mean"), numbers), 0.25);
    EXPECT_EQ(noise_of(*find_column("error.signed_mean"), numbers), 0.125);
    EXPECT_EQ(noise_of(*find_column("error.iou"), numbers), 0);
    EXPECT_TRUE(std::isnan(plotted_value(*find_column("error.mae"), numbers)));
    EXPECT_TRUE(std::isnan(plotted_value(*find_column("error.acne"), numbers)));
    EXPECT_TRUE(std::isnan(plotted_value(*find_column("time.total_ms.median"), numbers))) << "not taken";
    EXPECT_TRUE(std::isnan(plotted_value(*find_column("error.outside_map"), numbers))) << "a fact, no quality";
    for (const Column& c : columns()) EXPECT_TRUE(c.help.ends_with(".")) << c.key;
}

}  // namespace
}  // namespace si
