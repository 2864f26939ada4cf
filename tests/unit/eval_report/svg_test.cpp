// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "eval_report/box_plot_svg.hpp"
#include "eval_report/error_map_svg.hpp"
#include "eval_report/linear_scale.hpp"
#include "eval_report/markup.hpp"
#include "eval_report/screen_svg.hpp"

namespace telehug {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Scales, PlaceValuesEvenlyAlsoDownwards) {
  const LinearScale scale(-10, 10, 200, 100);
  EXPECT_DOUBLE_EQ(scale.px(0), 150);
  EXPECT_DOUBLE_EQ(scale.px(10), 100);
  EXPECT_DOUBLE_EQ(scale.clamped_px(99), 100);
  EXPECT_DOUBLE_EQ(scale.clamped_px(-99), 200);
  EXPECT_TRUE(scale.holds(-10));
  EXPECT_FALSE(scale.holds(10.1));
}

TEST(Scales, HaveTicksAtRoundValues) {
  EXPECT_THAT(LinearScale(-12, 12, 0, 1).ticks(6), ElementsAre(-10, -5, 0, 5, 10));
  EXPECT_THAT(LinearScale(0, 100, 0, 1).ticks(5), ElementsAre(0, 20, 40, 60, 80, 100));
  EXPECT_THAT(LinearScale(0.13, 0.38, 0, 1).ticks(3), ElementsAre(DoubleEq(0.2), testing::DoubleNear(0.3, 1e-12)));
  EXPECT_FALSE(std::signbit(LinearScale(0, 300, 0, 1).ticks(4).front())) << "it would be written -0";
}

TEST(Markup, EscapesWhateverCouldEndATextOrAnAttribute) {
  EXPECT_EQ(escaped("<a href=\"x\" b='y'>&amp;\x01</a>"),
            "&lt;a href=&quot;x&quot; b=&#39;y&#39;&gt;&amp;amp;?&lt;/a&gt;");
  EXPECT_EQ(escaped("Käfer ≥ 10 mm\n"), "Käfer ≥ 10 mm\n");
}

// RFC 4648's examples.
TEST(Markup, CodesPicturesInBase64) {
  const auto coded = [](std::string_view text) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    return jpeg_uri(bytes).substr(std::string_view("data:image/jpeg;base64,").size());
  };
  EXPECT_EQ(coded(""), "");
  EXPECT_EQ(coded("f"), "Zg==");
  EXPECT_EQ(coded("fo"), "Zm8=");
  EXPECT_EQ(coded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(jpeg_uri(std::array<std::uint8_t, 3>{0xFF, 0xD8, 0xFF}), "data:image/jpeg;base64,/9j/");
}

TEST(BoxPlotPictures, CountWhatLiesBeyondTheAxis) {
  const std::string svg = box_plots_svg("Error <mm>", {{"all", {-90, -1, 0, 0, 0, 1, 5, 70, 80}}, {"none", {}}}, 12);
  EXPECT_THAT(svg, HasSubstr("1 ◂"));
  EXPECT_THAT(svg, HasSubstr("▸ 2"));
  EXPECT_THAT(svg, HasSubstr("all (9)"));
  EXPECT_THAT(svg, HasSubstr("none (0)"));
  EXPECT_THAT(svg, HasSubstr("Error &lt;mm&gt;"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

ReportedTouch touch_at(double x_mm, double y_mm, bool found, double error_mm) {
  return {"f<1>", {400, 300, 1280, 1024}, {}, {"1", "II", "chat", found, error_mm, 0, {x_mm, y_mm}, "touch"}};
}

TEST(ErrorMaps, AverageTheTouchesOfEachField) {
  const ErrorMap map = map_errors(
      {touch_at(10, 10, true, 2), touch_at(20, 20, true, 4), touch_at(399, 299, true, 6), touch_at(200, 150, false, 0)},
      [](const ScoredTouch& touch) { return touch.found ? std::optional(touch.vertical_error_mm) : std::nullopt; });
  EXPECT_EQ(map.cells.front().touches, 2U);
  EXPECT_DOUBLE_EQ(map.cells.front().value.value(), 3);
  EXPECT_DOUBLE_EQ(map.cells.back().value.value(), 6);
  EXPECT_FALSE(map.cells[ErrorMap::columns * 3 + 4].value.has_value());
  const std::string svg = error_map_svg("Errors", map, 5, 1);
  EXPECT_THAT(svg, HasSubstr(">3.0<"));
  EXPECT_THAT(svg, HasSubstr(">5.0<")) << "the legend's end";
}

TEST(ScreenPictures, JoinTrueAndFoundAndCrossWhatWasMissed) {
  const std::string svg = screen_svg({touch_at(100, 100, true, 3), touch_at(200, 100, false, 0)}, true);
  EXPECT_THAT(svg, HasSubstr("f&lt;1&gt;: 3.0 mm off"));
  EXPECT_THAT(svg, HasSubstr("class=\"error\""));
  EXPECT_THAT(svg, HasSubstr("f&lt;1&gt; missed"));
  EXPECT_EQ(screen_svg({}, true), "");
}

TEST(ScreenPictures, ShowSomeOfVeryManyAndSayHowMany) {
  const std::vector<ReportedTouch> touches(1001, touch_at(100, 100, true, 3));
  EXPECT_THAT(screen_svg(touches, false), HasSubstr("1 touch of 3"));
}

}  // namespace
}  // namespace telehug
