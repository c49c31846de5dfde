#include "esi/recon/edi.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "edi_reference.hpp"
#include "esi/core/error.hpp"
#include "support/random_events.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

constexpr SensorSize kThree{3, 3};
constexpr double kContrast = 0.3;

Event at(std::int64_t t_us, bool on) { return {t_us, 1, 1, on}; }

EdiOptions with(ReferenceTime reference) { return {.contrast = kContrast, .reference = reference}; }

IntensityFrame flat_frame(Interval exposure, int grey) {
  return {exposure, cv::Mat1b(3, 3, static_cast<std::uint8_t>(grey))};
}

double middle_level(Reconstructor& method, std::int64_t t_us = 0) {
  cv::Mat1f levels;
  method.render_levels(t_us, levels);
  REQUIRE(levels.size() == cv::Size(3, 3));
  return static_cast<double>(levels(1, 1));
}

}  // namespace

TEST_CASE("a frame without events in its exposure is shown as it is, whatever its bits") {
  Edi edi({}, kThree);
  EdiPropagated propagated({}, kThree);
  for (Reconstructor* method :
       {static_cast<Reconstructor*>(&edi), static_cast<Reconstructor*>(&propagated)}) {
    CHECK(middle_level(*method) == 127.5);
    cv::Mat1b all(16, 16), shown;
    for (int i = 0; i < 256; ++i) all(i / 16, i % 16) = static_cast<std::uint8_t>(i);
    for (int part = 0; part < 256; part += 9) {
      const cv::Mat1b image = (cv::Mat1b(3, 3) << part, part + 1, part + 2, part + 3, 255, 0, 7, 8, 9);
      method->observe({{part, part + 1}, image});
      method->render(part + 1, shown);
      REQUIRE(cv::norm(shown, image, cv::NORM_INF) == 0);
    }
    method->observe({{1000, 2000}, cv::Mat1w(3, 3, static_cast<std::uint16_t>(32639))});
    CHECK(middle_level(*method) == Approx(127.0).epsilon(1e-4));
  }
}

TEST_CASE("one event in an exposure splits the blurred value into before and after") {
  // Exposure 0..10 ms, ON at 4 ms: B = I0 (0.4 + 0.6 e^c).
  const double mean = 0.4 + 0.6 * std::exp(kContrast);
  const auto [reference, level] =
      GENERATE_COPY(table<ReferenceTime, double>({{ReferenceTime::start, 100.0 / mean},
                                                  {ReferenceTime::middle, 100.0 / mean * std::exp(kContrast)},
                                                  {ReferenceTime::end, 100.0 / mean * std::exp(kContrast)}}));
  Edi edi(with(reference), kThree);
  edi.process(std::vector<Event>{at(-1, true), at(4000, true)});  // the first is before the exposure
  edi.observe(flat_frame({0, 10000}, 100));
  edi.process(std::vector<Event>{at(10000, false)});  // and this one after it
  CHECK(middle_level(edi) == Approx(level).epsilon(1e-5));
}

TEST_CASE("events at the exposure's bounds and at the reference time fall on their sides") {
  const double up = std::exp(kContrast);
  struct Row {
    std::int64_t t_us;
    double level;
  };
  const auto row = GENERATE_COPY(Row{0, 100.0},  // at the begin: all of the exposure comes after it
                                 Row{4999, 100.0 / (0.4999 + 0.5001 * up) * up},
                                 Row{5000, 100.0 / (0.5 + 0.5 * up)},  // at f: not yet
                                 Row{9999, 100.0 / (0.9999 + 0.0001 * up)}, Row{10000, 100.0});
  Edi edi(with(ReferenceTime::middle), kThree);
  if (row.t_us < 10000) edi.process(std::vector<Event>{at(row.t_us, true)});
  edi.observe(flat_frame({0, 10000}, 100));
  if (row.t_us >= 10000) edi.process(std::vector<Event>{at(row.t_us, true)});
  CHECK(middle_level(edi) == Approx(row.level).epsilon(1e-5));
}

TEST_CASE("edi-propagated carries the sharp image on, edi doesn't") {
  const double up = std::exp(kContrast);
  Edi edi(with(ReferenceTime::middle), kThree);
  EdiPropagated propagated(with(ReferenceTime::middle), kThree);
  const std::vector<Event> during{at(2500, true), at(7500, true)};
  const double sharp = 100.0 / (0.25 / up + 0.5 + 0.25 * up);
  for (Reconstructor* method :
       {static_cast<Reconstructor*>(&edi), static_cast<Reconstructor*>(&propagated)}) {
    method->process(during);
    method->observe(flat_frame({0, 10000}, 100));
  }
  CHECK(middle_level(edi) == Approx(sharp).epsilon(1e-5));
  CHECK(middle_level(propagated) == Approx(sharp * up).epsilon(1e-5));  // with the event behind f
  for (int i = 0; i < 3; ++i) propagated.process(std::vector<Event>{at(20000 + i, false)});
  CHECK(middle_level(propagated) == Approx(sharp / up / up).epsilon(1e-5));
  propagated.observe(flat_frame({30000, 40000}, 50));  // starts anew
  CHECK(middle_level(propagated) == Approx(50.0).epsilon(1e-5));
}

TEST_CASE("a frame that is told late is carried on by the events since its exposure") {
  const double up = std::exp(kContrast);
  const Interval exposure = GENERATE(Interval{0, 10000}, Interval{10000, 10000});
  Edi edi(with(ReferenceTime::end), kThree);
  EdiPropagated propagated(with(ReferenceTime::end), kThree);
  for (Reconstructor* method :
       {static_cast<Reconstructor*>(&edi), static_cast<Reconstructor*>(&propagated)}) {
    method->process(std::vector<Event>{at(-1, true), at(10000, true), at(12000, true)});
    method->observe(flat_frame(exposure, 50));
  }
  CHECK(middle_level(edi) == Approx(50.0).epsilon(1e-5));
  CHECK(middle_level(propagated) == Approx(50.0 * up * up).epsilon(1e-5));
}

TEST_CASE("a frame with one time only is sharp already") {
  const auto reference = GENERATE(ReferenceTime::start, ReferenceTime::middle, ReferenceTime::end);
  EdiPropagated edi(with(reference), kThree);
  edi.process(std::vector<Event>{at(0, true), at(9999, true)});
  edi.observe(flat_frame({10000, 10000}, 100));
  CHECK(middle_level(edi) == Approx(100.0).epsilon(1e-5));
  edi.process(std::vector<Event>{at(10000, true)});
  CHECK(middle_level(edi) == Approx(100.0 * std::exp(kContrast)).epsilon(1e-5));
}

TEST_CASE("black stays black without events, and brightens from half a grey level with them") {
  EdiPropagated edi(with(ReferenceTime::end), kThree);
  edi.observe(flat_frame({0, 1000}, 0));
  CHECK(middle_level(edi) == Approx(0.5).epsilon(1e-5));
  for (int i = 0; i < 10; ++i) edi.process(std::vector<Event>{at(2000, true)});
  CHECK(middle_level(edi) == Approx(0.5 * std::exp(3.0)).epsilon(1e-5));
  cv::Mat1b grey;
  for (int i = 0; i < 1000; ++i) edi.process(std::vector<Event>{at(3000, true)});
  edi.render(4000, grey);
  CHECK(grey(1, 1) == 255);
}

TEST_CASE("frames of other sizes and endless exposures are refused in words") {
  Edi edi({}, kThree);
  CHECK_THROWS_WITH(edi.observe({{0, 0}, cv::Mat1b(4, 3)}), Contains("edi: ") && Contains("3x4 px"));
  CHECK_THROWS_WITH(edi.observe(flat_frame({0, 2000001}, 9)), Contains("edi: ") && Contains("2.000001"));
  edi.observe(flat_frame({0, 2000000}, 9));
  CHECK(middle_level(edi) == Approx(9.0));
}

TEST_CASE("random events and several frames agree with the reference") {
  const SensorSize size{4, 3};
  const auto reference = GENERATE(ReferenceTime::start, ReferenceTime::middle, ReferenceTime::end);
  for (unsigned seed = 0; seed < 12; ++seed) {
    const int gap_us = seed % 2 == 0 ? 200 : 2000;
    const auto events = test::random_events({0, 0, 4, 3}, 1500, gap_us, seed);
    std::mt19937 random(seed);
    std::vector<float> weights(events.size());
    for (float& weight : weights) weight = static_cast<float>(random() % 5) / 4.0F;
    Edi edi(with(reference), size);
    EdiPropagated propagated(with(reference), size);
    std::size_t fed = 0;
    const auto feed = [&](std::size_t end) {
      const auto part = std::span(events).subspan(fed, end - fed);
      const auto part_weights = std::span(weights).subspan(fed, end - fed);
      edi.process(part, part_weights);
      propagated.process(part, part_weights);
      fed = end;
    };
    std::int64_t begin_us = 0;
    for (const std::int64_t length_us : {std::int64_t{20000}, std::int64_t{0}, std::int64_t{35001}}) {
      const Interval exposure{begin_us + 5000, begin_us + 5000 + length_us};
      const cv::Mat1b image(size.height_px, size.width_px, static_cast<std::uint8_t>(40 + random() % 100));
      std::size_t end = fed;
      while (events[end].t_us < exposure.end_us) ++end;
      feed(end);
      edi.observe({exposure, image});
      propagated.observe({exposure, image});
      begin_us = exposure.end_us;
      const std::int64_t t_us = exposure.end_us + 3000;
      while (events[end].t_us < t_us) ++end;
      feed(end);

      const std::int64_t f_us = reference == ReferenceTime::start ? exposure.begin_us
                                : reference == ReferenceTime::middle
                                    ? (exposure.begin_us + exposure.end_us) / 2
                                    : exposure.end_us;
      cv::Mat1f sharp, carried;
      edi.render_levels(t_us, sharp);
      propagated.render_levels(t_us, carried);
      for (int y = 0; y < size.height_px; ++y) {
        for (int x = 0; x < size.width_px; ++x) {
          std::vector<test::EdiReference::Step> steps;
          for (std::size_t i = 0; i < fed; ++i) {
            const double weight = static_cast<double>(weights[i]);
            if (events[i].x == x && events[i].y == y)
              steps.push_back({events[i].t_us, events[i].on ? weight : -weight});
          }
          const test::EdiReference pixel(steps, kContrast);
          const double expected = pixel.sharp(image(y, x), exposure, f_us);
          REQUIRE(sharp(y, x) == Approx(expected).epsilon(2e-5));
          REQUIRE(carried(y, x) == Approx(pixel.carried_on(expected, f_us, t_us)).epsilon(2e-5));
        }
      }
    }
  }
}
