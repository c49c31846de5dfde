#include "esi/io/aedat4/header.hpp"

#include <aedat4_generated.h>
#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"

namespace esi {
namespace {

// The XML of a real recording has 3 kB.
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 24;

Codec codec_of(aedat4::Compression compression, const std::string& name) {
  switch (compression) {
    case aedat4::Compression::NONE:
      return Codec::none;
    case aedat4::Compression::LZ4:
    case aedat4::Compression::LZ4_HIGH:
      return Codec::lz4;
    case aedat4::Compression::ZSTD:
    case aedat4::Compression::ZSTD_HIGH:
      return Codec::zstd;
  }
  throw Error(
      fmt::format("{}: the header says compression {}, but 0 to 4 are known; the file is damaged or newer",
                  name, static_cast<int>(compression)));
}

/// The header's FlatBuffer with its size in front, in memory aligned for it.
std::vector<std::byte> take_header(ByteWindow& bytes) {
  const auto prefix = bytes.peek(sizeof(flatbuffers::uoffset_t));
  if (prefix.size() < sizeof(flatbuffers::uoffset_t)) {
    throw Error(fmt::format("{}: the file ends within its header, at byte {}; copy it again", bytes.name(),
                            bytes.position() + prefix.size()));
  }
  const std::size_t size = prefix.size() + flatbuffers::ReadScalar<flatbuffers::uoffset_t>(prefix.data());
  if (size > kMaxHeaderBytes) {
    throw Error(fmt::format("{}: the header at byte {} claims {} bytes, which can't be; the file is damaged",
                            bytes.name(), bytes.position(), size));
  }
  const auto header = bytes.take(size);
  if (header.size() < size) {
    throw Error(fmt::format("{}: the file ends within its header, at byte {}; copy it again", bytes.name(),
                            bytes.position()));
  }
  return {header.begin(), header.end()};
}

}  // namespace

const Aedat4Stream* Aedat4Header::find(int id) const {
  const auto found =
      std::find_if(streams.begin(), streams.end(), [id](const Aedat4Stream& s) { return s.id == id; });
  return found == streams.end() ? nullptr : &*found;
}

std::string Aedat4Header::streams_text() const {
  std::string text;
  for (const Aedat4Stream& stream : streams) text += (text.empty() ? "" : ", ") + stream.text();
  return text;
}

Aedat4Header read_aedat4_header(ByteWindow& bytes) {
  bytes.skip(kAedat4Magic.size());
  const std::size_t position = bytes.position();
  const std::vector<std::byte> buffer = take_header(bytes);
  const auto* const data = reinterpret_cast<const std::uint8_t*>(buffer.data());
  flatbuffers::Verifier verifier(data, buffer.size());
  if (!verifier.VerifySizePrefixedBuffer<aedat4::IOHeader>("IOHE")) {
    throw Error(
        fmt::format("{}: the header at byte {} is damaged; copy the file again", bytes.name(), position));
  }
  const auto* const io_header = flatbuffers::GetSizePrefixedRoot<aedat4::IOHeader>(data);

  Aedat4Header header;
  header.codec = codec_of(io_header->compression(), bytes.name());
  header.compression = aedat4::EnumNameCompression(io_header->compression());
  header.data_table_position = io_header->data_table_position();
  const flatbuffers::String* const xml = io_header->info_node();
  if (xml == nullptr) {
    throw Error(
        fmt::format("{}: the header at byte {} has no XML that lists the streams; the file is damaged",
                    bytes.name(), position));
  }
  header.streams = parse_aedat4_streams({xml->c_str(), xml->size()}, bytes.name());
  return header;
}

}  // namespace esi
