#include "figures/gnuplot_renderer.h"
#include "figures/gnuplot_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>

#include "figures/figure.h"
#include "figures/figure_file.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/interrupt.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace test_gnuplot_renderer {

using namespace dynlab;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Figure sine(const std::string& label = "a curve") {
    Curve curve;
    curve.x = Vector::LinSpaced(200, 0, 10);
    curve.y = curve.x.array().sin();
    curve.label = Message::verbatim(label);
    Panel panel;
    panel.x_label = Message("time (s)");
    panel.y_label = Message("Height (mm)");
    panel.curves = {curve};
    return Figure(panel);
}

std::size_t file_count(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

std::filesystem::path draw_one(GnuplotRenderer& renderer, const Figure& figure, const std::filesystem::path& file) {
    renderer.draw(figure, file, figure_format(file));
    renderer.finish();
    return file;
}

// Oracle: the formats' own signatures.
TEST(gnuplot_renderer, writes_whole_files_of_all_formats) {
    const TemporaryFolder folder;
    GnuplotRenderer renderer;
    for (const char* name : {"a.pdf", "a.svg", "a.png"})
        renderer.draw(sine(), folder.path() / name, figure_format(name));
    renderer.finish();
    EXPECT_EQ(file_count(folder.path()), 3u);
    EXPECT_THAT(read_file(folder.path() / "a.pdf"), StartsWith("%PDF"));
    EXPECT_THAT(read_file(folder.path() / "a.png"), StartsWith("\x89PNG"));
    const std::string svg = read_file(folder.path() / "a.svg");
    for (const char* text : {"time (s)", "Height (mm)", "a curve", "</svg>"}) EXPECT_THAT(svg, HasSubstr(text));
}

TEST(gnuplot_renderer, equal_figures_make_equal_files) {
    const TemporaryFolder folder;
    GnuplotRenderer first, second;
    for (const std::string kind : {".pdf", ".svg", ".png"}) {
        draw_one(second, sine("another"), folder.path() / ("other" + kind));
        const auto a = draw_one(first, sine("θ̂"), folder.path() / ("a" + kind));
        const auto b = draw_one(second, sine("θ̂"), folder.path() / ("b" + kind));
        EXPECT_TRUE(read_file(a) == read_file(b)) << kind;
    }
    // Dates differ only when the clock ticks between two files, so look for the date itself.
    for (const std::string& trace : {std::string("CreationDate"), folder.path().string()})
        EXPECT_EQ(read_file(folder.path() / "a.pdf").find(trace), std::string::npos) << trace;
}

// Oracle: the file that gnuplot drew, and that no gnuplot runs for it again.
TEST(gnuplot_renderer, takes_what_was_drawn_before_from_its_cache) {
    const TemporaryFolder folder, cache;
    const test::EnvironmentVariable cache_home("XDG_CACHE_HOME", cache.path());
    const Cache store;
    for (const std::string kind : {".pdf", ".svg", ".png"}) {
        GnuplotRenderer first(&store);
        draw_one(first, sine(), folder.path() / ("a" + kind));
        EXPECT_EQ(first.use().from_cache, 0u) << kind;
        EXPECT_EQ(first.use().made, 1u) << kind;
    }
    GnuplotRenderer second(&store);
    for (const std::string kind : {".pdf", ".svg", ".png"}) {
        draw_one(second, sine(), folder.path() / ("b" + kind));
        EXPECT_TRUE(read_file(folder.path() / ("a" + kind)) == read_file(folder.path() / ("b" + kind))) << kind;
    }
    EXPECT_EQ(second.use().from_cache, 3u);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a gnuplot was started";
    Figure wider = sine();
    wider.width_cm += 1;
    draw_one(second, wider, folder.path() / "c.pdf");
    EXPECT_EQ(second.use().from_cache, 3u);
}

// Oracle: the file of the later figure, drawn alone.
TEST(gnuplot_renderer, a_file_drawn_twice_is_the_later_figure) {
    const TemporaryFolder folder, cache;
    const test::EnvironmentVariable cache_home("XDG_CACHE_HOME", cache.path());
    const Cache store;
    GnuplotRenderer renderer(&store);
    const auto alone = draw_one(renderer, sine("later"), folder.path() / "alone.svg");
    renderer.draw(sine("earlier"), folder.path() / "a.svg", FigureFormat::kSvg);
    renderer.draw(sine("later"), folder.path() / "a.svg", FigureFormat::kSvg);
    renderer.finish();
    EXPECT_EQ(renderer.use().from_cache, 1u);
    EXPECT_TRUE(read_file(alone) == read_file(folder.path() / "a.svg"));
    EXPECT_EQ(file_count(folder.path()), 2u);
}

// Oracle: no side effect. Each text would create a file if gnuplot or a shell ever executed a part of it.
TEST(gnuplot_renderer, texts_never_become_commands) {
    const TemporaryFolder folder;
    const std::string bad = (folder.path() / "bad").string();
    const std::vector<std::string> attacks = {"`touch " + bad + "`",
                                              "\"`touch " + bad + "`\"",
                                              "'; system 'touch " + bad + "'; '",
                                              "\\'; system \"touch " + bad + "\" #",
                                              "x\nsystem 'touch " + bad + "'\n",
                                              "x\r\n! touch " + bad + "\n",
                                              "'\nset output '" + bad + "'\nplot 1\n",
                                              "EOD\nsystem 'touch " + bad + "'",
                                              "$(touch " + bad + ") @macro $d0 %s %n %d",
                                              "{/'; system 'touch " + bad + "' '} _{'} ^{\\'} \\",
                                              "\xC3' ; system 'touch " + bad + "' \xF0\x9F",
                                              std::string(100000, '\''),
                                              std::string("a\0'\nsystem 'touch ", 19) + bad + "'",
                                              "</text><script>x</script>"};
    GnuplotRenderer renderer;
    int number = 0;
    for (const std::string& attack : attacks) {
        Figure figure = sine(attack);
        const Message label = Message::verbatim(attack);
        figure.title = label;
        Panel& panel = figure.panels[0];
        panel.title = panel.x_label = panel.y_label = label;
        panel.references = {{true, 0.5, label, 1}, {false, 5, label, 1}};
        panel.annotations = {{3, 0.2, label, true}};
        panel.arrows = {{1, 0, 2, 0.5, label, true}};
        for (const char* kind : {".pdf", ".svg", ".png"}) {
            const auto file = folder.path() / (std::to_string(number++) + kind);
            ASSERT_NO_THROW(draw_one(renderer, figure, file)) << attack.substr(0, 60);
        }
        ASSERT_FALSE(std::filesystem::exists(bad)) << attack.substr(0, 60);
        EXPECT_THAT(read_file(folder.path() / (std::to_string(number - 2) + ".svg")), Not(HasSubstr("<script>")));
    }
    EXPECT_EQ(file_count(folder.path()), static_cast<std::size_t>(number));
}

TEST(gnuplot_renderer, file_names_are_names_only) {
    const TemporaryFolder folder;
    GnuplotRenderer renderer;
    const auto file = draw_one(renderer, sine(), folder.path() / "it's `touch bad` | $x \"y\".pdf");
    EXPECT_TRUE(std::filesystem::exists(file));
    EXPECT_EQ(file_count(folder.path()), 1u);
    EXPECT_THROW(renderer.draw(sine(), folder.path() / "a\nb.pdf", FigureFormat::kPdf), InvalidArgument);
}

TEST(gnuplot_renderer, bad_targets_are_reported_and_leave_nothing) {
    const TemporaryFolder folder;
    GnuplotRenderer renderer;
    EXPECT_THROW(renderer.draw(sine(), folder.path() / "absent" / "a.pdf", FigureFormat::kPdf), EnvironmentError);
    EXPECT_THROW(figure_format("a.jpeg"), InvalidArgument);
    draw_one(renderer, sine(), folder.path() / "a.pdf");  // the renderer still works
    EXPECT_EQ(file_count(folder.path()), 1u);
}

TEST(gnuplot_renderer, files_of_a_killed_process_are_removed_by_the_next_figure) {
    const TemporaryFolder folder;
    const pid_t killed = ::fork();
    if (killed == 0) {
        const TemporaryFile begun =
            make_temporary_next_to(folder.path() / "a.pdf");  // gnuplot could draw on for a while
        ::raise(SIGKILL);
    }
    ::waitpid(killed, nullptr, 0);
    EXPECT_EQ(file_count(folder.path()), 1u);
    GnuplotRenderer renderer;
    renderer.draw(sine(), folder.path() / "b.pdf", FigureFormat::kPdf);
    renderer.finish();
    EXPECT_EQ(file_count(folder.path()), 1u);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "b.pdf"));
}

TEST(gnuplot_renderer, figures_not_finished_leave_nothing) {
    const TemporaryFolder folder;
    {
        GnuplotRenderer renderer;
        for (int i = 0; i < 5; ++i)
            renderer.draw(sine(), folder.path() / (std::to_string(i) + ".pdf"), FigureFormat::kPdf);
    }
    EXPECT_EQ(file_count(folder.path()), 0u);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child process was left behind";
}

// Oracle: a program in gnuplot's place that ends at once, complains, or is not there.
class WithGnuplotReplaced : public testing::Test {
  protected:
    void replace_by(const std::string& script) {
        const auto program = folder_.path() / "gnuplot";
        std::ofstream(program) << "#!/bin/sh\n" << script;
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    }
    std::string failure(const Figure& figure = sine()) {
        GnuplotRenderer renderer;
        try {
            renderer.draw(figure, out_.path() / "a.pdf", FigureFormat::kPdf);
            renderer.finish();
        } catch (const FigureError& error) {
            EXPECT_EQ(file_count(out_.path()), 0u);
            return error.what();
        }
        return "";
    }
    TemporaryFolder folder_, out_;
    test::EnvironmentVariable path_{"PATH", folder_.path()};
};
using gnuplot_renderer_replaced = WithGnuplotReplaced;

TEST_F(gnuplot_renderer_replaced, missing_gnuplot_names_its_package) {
    GnuplotRenderer renderer;
    try {
        renderer.draw(sine(), out_.path() / "a.pdf", FigureFormat::kPdf);
        FAIL() << "no complaint";
    } catch (const MissingProgram& error) {
        EXPECT_THAT(error.what(), HasSubstr("gnuplot-nox"));
    }
    EXPECT_EQ(file_count(out_.path()), 0u);
}

TEST_F(gnuplot_renderer_replaced, death_is_reported_with_its_last_words) {
    replace_by("echo 'cannot open terminal' >&2\nexit 1\n");
    EXPECT_THAT(failure(), HasSubstr("a.pdf"));
}

TEST_F(gnuplot_renderer_replaced, complaints_become_one_sentence) {
    replace_by(
        "echo 'gnuplot> plot' >&2; echo '         line 0: all points y value undefined!' >&2\n"
        "echo 'figure 1 done' >&2\nwhile read -r line; do :; done\n");
    const std::string text = failure();
    EXPECT_THAT(text, HasSubstr("all points y value undefined!"));
    EXPECT_THAT(text, Not(HasSubstr("\n")));
}

TEST_F(gnuplot_renderer_replaced, an_error_that_ends_gnuplot_is_reported) {
    replace_by(
        "read -r line; echo '\"/dev/stdin\" line 1: warning: odd' >&2\n"
        "echo '\"/dev/stdin\" line 7: undefined variable: x' >&2; exit 1\n");
    EXPECT_THAT(failure(), testing::EndsWith("a.pdf\": undefined variable: x"));
}

TEST_F(gnuplot_renderer_replaced, an_error_is_reported_that_comes_after_the_pipe_has_broken) {
    replace_by("exec 0<&-; sleep 0.2; echo '\"/dev/stdin\" line 7: undefined variable: x' >&2\n");
    Figure large = sine();  // more than a pipe holds: writing it fails before anything is said
    Curve& curve = large.panels.front().curves.front();
    curve.x = Vector::LinSpaced(1000, 0, 10);
    curve.y = Vector::Random(1000);
    large.panels.front().curves.assign(60, curve);
    EXPECT_THAT(failure(large), testing::EndsWith("a.pdf\": undefined variable: x"));
}

TEST_F(gnuplot_renderer_replaced, files_that_are_not_whole_are_not_delivered) {
    replace_by("echo 'figure 1 done' >&2\nwhile read -r line; do :; done\n");
    EXPECT_THAT(failure(), HasSubstr("incomplete"));
}

TEST_F(gnuplot_renderer_replaced, ctrl_c_ends_the_wait_and_leaves_nothing) {
    replace_by("while read -r line; do :; done\nwhile :; do :; done\n");
    const InterruptScope scope;
    {
        GnuplotRenderer renderer;
        renderer.draw(sine(), out_.path() / "a.pdf", FigureFormat::kPdf);
        std::raise(SIGINT);
        EXPECT_THROW(renderer.finish(), Interrupted);
    }
    EXPECT_EQ(file_count(out_.path()), 0u);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child process was left behind";
}

TEST(gnuplot_renderer, targets_that_cannot_be_replaced_are_named) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "a.pdf");
    GnuplotRenderer renderer;
    EXPECT_THROW(draw_one(renderer, sine(), folder.path() / "a.pdf"), FigureError);
    EXPECT_EQ(file_count(folder.path()), 1u);
}

// Oracle: the bytes a reader would expect of a figure on paper: a million points weigh no more than a thousand would.
TEST(gnuplot_renderer, a_million_points_stay_small) {
    const TemporaryFolder folder;
    std::mt19937 generator(1);
    std::normal_distribution<double> normal;
    Figure figure = sine();
    Curve& curve = figure.panels[0].curves[0];
    curve.x = Vector::LinSpaced(1000000, 0, 1);
    curve.y.resize(1000000);
    for (double& value : curve.y) value = normal(generator);
    GnuplotRenderer renderer;
    EXPECT_LT(std::filesystem::file_size(draw_one(renderer, figure, folder.path() / "a.pdf")), 150000u);
}

// Oracle: gnuplot accepts the figure without an error. Only a reader can inspect a picture of extremes.
TEST(gnuplot_renderer, extreme_data_are_drawn) {
    const TemporaryFolder folder;
    GnuplotRenderer renderer;
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    const std::vector<Vector> extremes = {
        Vector{{1e-300, 2e-300}},        Vector{{-1e308, 1e308}}, Vector{{5}},
        Vector{{1, nan, infinity, 2}},   Vector{{0, 0, 0}},       Vector{{1e12, 1e12 + 1}},
        Vector{{-1e-9, -2e-9, -1.5e-9}}, Vector{{1, 1 + 1e-16}}};
    int number = 0;
    for (const Vector& values : extremes)
        for (const CurveStyle style : {CurveStyle::kLine, CurveStyle::kPoints, CurveStyle::kLinePoints,
                                       CurveStyle::kStairs, CurveStyle::kStems, CurveStyle::kBars, CurveStyle::kBand})
            for (const bool log : {false, true}) {
                Figure figure = sine();
                Panel& panel = figure.panels[0];
                panel.log_y = log && values.maxCoeff<Eigen::PropagateNumbers>() > 0;
                panel.curves[0].style = style;
                panel.curves[0].x = Vector::LinSpaced(values.size(), 1, static_cast<double>(values.size()));
                panel.curves[0].y = panel.curves[0].y_upper = values;
                renderer.draw(figure, folder.path() / (std::to_string(number++) + ".svg"), FigureFormat::kSvg);
            }
    EXPECT_NO_THROW(renderer.finish());
    EXPECT_EQ(file_count(folder.path()), static_cast<std::size_t>(number));
}

// Oracle: gnuplot's numbers are finite. A bar around a small number of a logarithmic axis begins below zero.
TEST(gnuplot_renderer, bars_on_logarithmic_axes_begin_at_the_frame) {
    for (const double x : {1e-149, 0.2}) {
        Figure figure = sine();
        Panel& panel = figure.panels[0];
        panel.log_x = true;
        panel.curves[0].style = CurveStyle::kBars;
        panel.curves[0].x = Vector::Constant(1, x);
        panel.curves[0].y = Vector::Constant(1, 2);
        const std::string script = gnuplot_script(figure, FigureFormat::kPdf);
        EXPECT_EQ(script.find("nan "), script.npos) << x;
        EXPECT_NE(script.find("\n0.0000 0.0000 0.0000 "), script.npos) << x << "\n" << script;
    }
}

}  // namespace test_gnuplot_renderer
