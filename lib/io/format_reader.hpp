#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/packet.hpp"
#include "esi/io/byte_source.hpp"
#include "esi/io/losses.hpp"
#include "esi/io/read_options.hpp"

namespace esi {

/// What a recording says of itself, and what had to be assumed.
struct RecordingHeader {
  std::string format;                 ///< the row of the formats table
  std::string layout;                 ///< "csv, columns t,x,y,p", "DSEC", "AEDAT 4, LZ4"
  std::optional<SensorSize> sensor;   ///< from the file; empty where it has none
  bool has_packets = false;           ///< whether the file is made of packets of its own
  bool has_intensity_frames = false;  ///< whether the file declares a stream of intensity frames
  std::vector<std::string> notes;     ///< assumptions and oddities, each a sentence; may grow while reading
};

/// Turns one file format into events. A reader converts units, polarity and origin, and leaves everything
/// else (order, sensor bounds, the clock's zero) to EventGate.
class FormatReader {
 public:
  virtual ~FormatReader() = default;

  virtual const RecordingHeader& header() const = 0;

  /// Appends about kPacketEvents events, and what else the file has there, to `packet`. Returns false, having
  /// appended nothing, at the end of the recording. t_us is the recording's own time with its offset added.
  /// Events whose coordinates don't fit into 16 bits are counted as Drop::outside_sensor.
  /// Throws an Error "NAME: what, where, what to do".
  virtual bool read(Packet& packet, Losses& losses) = 0;

  /// How much of the recording has been read, 0 to 1, where that can be told. For progress only.
  virtual std::optional<double> fraction_read() const { return std::nullopt; }
};

/// One row of the formats table.
struct Format {
  std::string_view name;        ///< as in --list-formats
  std::string_view extensions;  ///< ".txt .csv", a proposal only
  std::string_view summary;     ///< one line
  /// Whether the first bytes are this format's.
  bool (*recognises)(std::span<const std::byte> head);
  std::unique_ptr<FormatReader> (*open)(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
};

/// How many bytes `recognises` gets (fewer where the file is shorter).
inline constexpr std::size_t kFormatHeadBytes = 4096;

/// Every known format, most specific first.
std::span<const Format> formats();

/// Opens a recording with the reader of the format that its first bytes show.
/// Throws an Error for unknown formats that says what was found and lists the known ones.
std::unique_ptr<FormatReader> open_reader(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace esi
