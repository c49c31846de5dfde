#include "esi/report/svg_picture.hpp"

#include <cairo.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "esi/core/error.hpp"

namespace esi {
namespace {

struct CairoDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};

struct GObjectDeleter {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
};

using Surface = std::unique_ptr<cairo_surface_t, CairoDeleter>;
using Context = std::unique_ptr<cairo_t, CairoDeleter>;
using Handle = std::unique_ptr<RsvgHandle, GObjectDeleter>;

constexpr double kScale = 2.0;
/// Cairo takes no image wider or higher than 32767.
constexpr double kLongestSide_px = 32000.0, kMostPixels = 50e6;

double scale_of(const Svg& svg) {
  const double side_px = std::max(svg.width_px(), svg.height_px());
  return std::min(
      {kScale, kLongestSide_px / side_px, std::sqrt(kMostPixels / (svg.width_px() * svg.height_px()))});
}

Error drawing_error(std::string_view reason) {
  return Error(fmt::format("a figure could not be drawn as a picture: {}", reason));
}

/// Takes the message of a failed call.
Error taken_error(GError* error) {
  const std::string reason = error != nullptr ? error->message : "no reason given";
  g_clear_error(&error);
  return drawing_error(reason);
}

/// What XML doesn't allow is replaced: a name is not to stop a picture. Svg sees to control characters.
std::string as_xml_allows(const std::string& text) {
  const std::unique_ptr<char, decltype(&g_free)> valid(
      g_utf8_make_valid(text.data(), static_cast<gssize>(text.size())), &g_free);
  std::string allowed = valid.get();
  for (const std::string_view no_character : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (std::size_t at = 0; (at = allowed.find(no_character, at)) != std::string::npos;) {
      allowed.replace(at, no_character.size(), "\xEF\xBF\xBD");
    }
  }
  return allowed;
}

Handle loaded(const std::string& text) {
  GError* error = nullptr;
  Handle handle(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(text.data()), text.size(), &error));
  if (handle == nullptr) throw taken_error(error);
  return handle;
}

cairo_status_t append(void* target, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void require_success(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw drawing_error(cairo_status_to_string(status));
}

}  // namespace

std::string png_of(const Svg& svg) {
  const Handle handle = loaded(as_xml_allows(svg.str()));
  const double scale = scale_of(svg), width_px = std::max(1.0, std::floor(scale * svg.width_px())),
               height_px = std::max(1.0, std::floor(scale * svg.height_px()));
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width_px),
                                                   static_cast<int>(height_px)));
  require_success(cairo_surface_status(surface.get()));
  const Context context(cairo_create(surface.get()));
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  const RsvgRectangle whole{0.0, 0.0, width_px, height_px};
  GError* error = nullptr;
  if (!rsvg_handle_render_document(handle.get(), context.get(), &whole, &error)) throw taken_error(error);
  require_success(cairo_status(context.get()));
  std::string png;
  require_success(cairo_surface_write_to_png_stream(surface.get(), append, &png));
  return png;
}

}  // namespace esi
