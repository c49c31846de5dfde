// The last frame of a recording, through the library.
#include <esi/io/event_source.hpp>
#include <esi/recon/methods.hpp>
#include <iostream>

int main(int, char** arguments) {
  esi::ReadOptions options;
  options.size = "128x96";
  const auto recording = esi::open_recording(arguments[1], options);
  const auto method = esi::method_named("esi").configure()->create(*recording->sensor_size());

  std::int64_t end_us = 0;
  for (esi::Packet packet; recording->next(packet);) {
    method->process(packet.events);
    if (!packet.events.empty()) end_us = packet.events.back().t_us + 1;
  }
  cv::Mat1b grey;
  method->render(end_us, grey);
  std::cout << grey.cols << "x" << grey.rows << " at " << end_us << " us, middle " << +grey(48, 64) << "\n";
}
