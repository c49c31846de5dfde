// The layouts of MVSEC, Monash and Metavision.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "esi/io/event_digest.hpp"
#include "esi/io/event_source.hpp"
#include "support/hdf5_layouts.hpp"
#include "support/hdf5_recordings.hpp"
#include "support/random_events.hpp"
#include "support/read_hdf5.hpp"
#include "support/scripted_reader.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;
using Catch::Contains;

constexpr std::int64_t kSince1970_us = 1744227144732712;

std::vector<Event> some_events(std::size_t count, std::int64_t t_begin_us = 0) {
  std::vector<Event> events = random_events({0, 0, 240, 180}, count, 5, 1);
  for (Event& event : events) event.t_us += t_begin_us;
  return events;
}

TEST_CASE("The tag board has the same digest in the layouts of MVSEC, Monash and Metavision") {
  const auto digests_path = shared_data("digests.json");
  if (!digests_path) return;
  const auto digests = nlohmann::json::parse(std::ifstream(*digests_path));
  struct Case {
    std::string name, layout;
    bool has_size;
    std::int64_t t_first_us;
  };
  for (const Case& test :
       {Case{"tagboard/tagboard.mvsec.hdf5", "MVSEC, left", false, kSince1970_us},
        Case{"tagboard/tagboard.monash_e2vid.h5", "Monash (event_utils)", true, kSince1970_us},
        Case{"tagboard/tagboard.metavision_plain.hdf5", "Metavision", true, 0}}) {
    const auto path = shared_data(test.name);
    if (!path) continue;
    INFO(test.name);
    ReadOptions options;
    options.size = test.has_size ? "" : "346x260";
    options.time_zero = TimeZero::file;
    options.strict = true;
    const auto source = open_recording(*path, options);
    CHECK(source->sensor_size() == SensorSize{346, 260});
    EventDigest digest;
    Packet packet;
    while (source->next(packet)) digest.add(packet.events);
    const nlohmann::json& truth = digests.at(test.name);
    CHECK(digest.events() == truth.at("events").get<std::int64_t>());
    CHECK(digest.t_first_us() == test.t_first_us);
    CHECK(digest.duration_us() == truth.at("duration_us").get<std::int64_t>());
    CHECK(digest.sum_x() == truth.at("sum_x").get<std::int64_t>());
    CHECK(digest.sum_y() == truth.at("sum_y").get<std::int64_t>());
    CHECK(digest.on() == truth.at("on").get<std::int64_t>());
    CHECK(digest.crc32() == truth.at("crc32").get<std::string>());
    CHECK(source->header().layout == test.layout);
    CHECK(source->header().notes.empty());
  }
}

TEST_CASE("Each HDF5 layout gives back the events that were written, and the sensor's size") {
  const TempFolder folder;
  for (const std::size_t count : {0, 1, 1000, 20000}) {
    const std::vector<Event> events = some_events(count);
    for (const auto& [layout, bytes] : {std::pair{"DSEC, TUM-VIE", hdf5_recording(events)},
                                        std::pair{"MVSEC, left", mvsec_recording(events)},
                                        std::pair{"Monash (event_utils)", monash_recording(events)},
                                        std::pair{"Metavision", metavision_hdf5_recording(events)}}) {
      INFO(layout << ", " << count << " events");
      const Reading reading = read_hdf5(folder.write("a.h5", bytes));
      CHECK(reading.header.layout == layout);
      CHECK(reading.events == events);
      const bool is_dsec = layout == std::string("DSEC, TUM-VIE");
      CHECK(reading.header.sensor == (is_dsec ? std::nullopt : std::optional(SensorSize{240, 180})));
      CHECK_FALSE(reading.losses.any());
      CHECK(reading.header.notes.empty());
      CHECK(reading.frames.size() == (layout == std::string("MVSEC, left") ? 1 : 0));
    }
  }
}

TEST_CASE("MVSEC: --stream chooses the camera, and is asked for only where there are two") {
  const TempFolder folder;
  const std::vector<Event> left = some_events(10);
  const std::vector<Event> right = some_events(20);
  {
    Hdf5Writer file(folder / "a.h5");
    write_mvsec(file, "/davis/left/events", mvsec_rows(left), 4);
    write_mvsec(file, "/davis/right/events", mvsec_rows(right), 4);
    write_images(file, "/davis/left/", {1, 2, 3}, std::vector<std::uint8_t>(6), {0});
  }
  ReadOptions options;
  CHECK_THAT(hdf5_error(folder / "a.h5", options, Error::Kind::usage), Contains("left and right"));
  options.stream = "right";
  const Reading reading = read_hdf5(folder / "a.h5", options);
  CHECK(reading.events == right);
  CHECK(reading.header.layout == "MVSEC, right");
  CHECK_FALSE(reading.header.sensor);
  CHECK_FALSE(reading.header.has_intensity_frames);
  options.stream = "left";
  CHECK(read_hdf5(folder / "a.h5", options).header.sensor == SensorSize{3, 2});
}

TEST_CASE("Monash files may have the older names and any kind of polarity") {
  struct Polarity {
    hid_t type;
    std::int8_t off, on;
  };
  const TempFolder folder;
  const std::vector<Event> events = some_events(300, kSince1970_us);
  for (const std::string last : {"s", ""}) {
    for (const Polarity& polarity :
         {Polarity{H5T_STD_U8LE, 0, 1}, Polarity{H5T_STD_I8LE, -1, 1}, Polarity{H5T_STD_I64BE, -1, 1}}) {
      {
        Hdf5Writer file(folder / "a.h5");
        write_monash(file, events);
        file.remove("/events/ps");
        std::vector<std::int8_t> values;
        for (const Event& event : events) values.push_back(event.on ? polarity.on : polarity.off);
        file.dataset("/events/p" + last, {values.size()}, {.type = polarity.type}, H5T_NATIVE_INT8,
                     values.data());
        if (last.empty()) {
          for (const std::string name : {"x", "y"}) {
            H5Lmove(file.id(), ("/events/" + name + "s").c_str(), H5L_SAME_LOC, ("/events/" + name).c_str(),
                    H5P_DEFAULT, H5P_DEFAULT);
          }
        }
      }
      CHECK(read_hdf5(folder / "a.h5").events == events);
    }
  }
}

TEST_CASE("The sensor's size is taken from the attributes of Monash and Metavision, or said to be none") {
  const TempFolder folder;
  const auto header_of = [&](const std::function<void(Hdf5Writer&)>& add) {
    {
      Hdf5Writer file(folder / "a.h5");
      add(file);
    }
    return read_hdf5(folder / "a.h5").header;
  };
  const auto monash = [&](const std::vector<double>& size) {
    return header_of([&](Hdf5Writer& file) {
      write_monash(file, {});
      if (!size.empty()) write_attribute(file, "/", "sensor_resolution", size);
    });
  };
  const auto metavision = [&](const std::string& geometry, bool is_variable) {
    return header_of([&](Hdf5Writer& file) {
      write_metavision(file, {}, 10);
      write_text_attribute(file, "/", "geometry", geometry, is_variable);
    });
  };
  CHECK(monash({260, 346}).sensor == SensorSize{346, 260});
  CHECK_FALSE(monash({}).sensor);
  CHECK(monash({}).notes.empty());
  for (const std::vector<double>& size : {std::vector<double>{0, 346}, {260, 70000}, {260.5, 346}, {260}}) {
    const RecordingHeader header = monash(size);
    CHECK_FALSE(header.sensor);
    CHECK_THAT(header.notes.at(0), Contains("sensor_resolution is no sensor size"));
  }
  CHECK_FALSE(monash({1, 2, 3}).sensor);
  for (const bool is_variable : {false, true}) {
    CHECK(metavision("1280x720", is_variable).sensor == SensorSize{1280, 720});
    CHECK_THAT(metavision("12\n80", is_variable).notes.at(0),
               Contains("geometry is no sensor size (\"12\\n80\")"));
    CHECK_FALSE(metavision(std::string(5000, '1'), is_variable).sensor);
  }
}

TEST_CASE("Metavision's records may have their fields in any order, of any integer type") {
  struct Record {
    std::int64_t extra, x, y, p, t;
  };
  const std::vector<Record> records = {{7, 1, 2, 0, -3}, {7, 100, 50, 1, 4}, {7, 3, 4, -1, 5}};
  const hid_t memory = H5Tcreate(H5T_COMPOUND, sizeof(Record));
  H5Tinsert(memory, "t", offsetof(Record, t), H5T_NATIVE_INT64);
  H5Tinsert(memory, "extra", offsetof(Record, extra), H5T_NATIVE_INT64);
  H5Tinsert(memory, "p", offsetof(Record, p), H5T_NATIVE_INT64);
  H5Tinsert(memory, "y", offsetof(Record, y), H5T_NATIVE_INT64);
  H5Tinsert(memory, "x", offsetof(Record, x), H5T_NATIVE_INT64);
  const TempFolder folder;
  for (const hid_t type : {H5T_STD_I8LE, H5T_STD_I16BE, H5T_STD_I32LE, H5T_STD_I64BE}) {
    for (const bool is_compressed : {false, true}) {
      const std::size_t size = H5Tget_size(type);
      const hid_t stored = H5Tcreate(H5T_COMPOUND, 5 * size + 3);
      std::size_t offset = 1;  // Nothing is aligned.
      for (const char* const name : {"t", "p", "extra", "x", "y"}) {
        H5Tinsert(stored, name, offset, type);
        offset += size;
      }
      {
        Hdf5Writer file(folder / "a.h5");
        Storage storage{.type = stored, .chunk = 2};
        if (is_compressed) storage.filters = gzip;
        file.dataset("/CD/events", {3}, storage, memory, records.data());
      }
      H5Tclose(stored);
      CHECK(read_hdf5(folder / "a.h5").events ==
            std::vector<Event>{{-3, 1, 2, false}, {4, 100, 50, true}, {5, 3, 4, false}});
    }
  }
  H5Tclose(memory);
}

}  // namespace
