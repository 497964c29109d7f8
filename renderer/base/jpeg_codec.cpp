// JPEG by way of libjpeg-turbo.
#include "renderer/base/error.h"
#include "renderer/base/image_codecs.h"

#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it
#include <new>

#include <jerror.h>
#include <jpeglib.h>

namespace cellcut {

namespace {

// A block of 8 × 8 pixels takes at least one bit.
constexpr std::int64_t kJpegPixelsPerByte = 8 * 64;
// Each goes over the whole picture, however few bytes it has. Most progressive pictures have 10.
constexpr int kMaxScans = 128;

/// One picture. The library reports errors by a function that must not return: it jumps back into `run`, so nothing with
/// a destructor may live in what that calls.
class Decompressor {
 public:
  explicit Decompressor(const std::string& name) : name_(name) {
    info_.err = jpeg_std_error(&errors_);
    info_.client_data = this;
    errors_.error_exit = [](j_common_ptr from) { std::longjmp(of(from).back_, kFatal); };
    errors_.emit_message = [](j_common_ptr from, int level) {
      if (level < 0 && from->err->num_warnings++ == 0) from->err->format_message(from, of(from).warning_.data());
    };
    run("cannot be decoded", [&] { jpeg_create_decompress(&info_); });  // keeps these two, and nothing else
    progress_.progress_monitor = [](j_common_ptr from) {
      if (of(from).info_.input_scan_number > kMaxScans) std::longjmp(of(from).back_, kTooManyScans);
    };
    info_.progress = &progress_;
  }
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;
  ~Decompressor() { jpeg_destroy_decompress(&info_); }

  /// \throws InputError that says so if the library cannot go on
  template <class Call>
  void run(const char* failure, const Call& call) {
    switch (setjmp(back_)) {
      case 0:
        return call();
      case kTooManyScans:
        throw InputError(name_, "has more than " + std::to_string(kMaxScans) + " JPEG scans; save it again");
      default:
        break;
    }
    if (errors_.msg_code == JERR_OUT_OF_MEMORY) throw std::bad_alloc();
    std::array<char, JMSG_LENGTH_MAX> reason{};
    errors_.format_message(reinterpret_cast<j_common_ptr>(&info_), reason.data());
    throw InputError(name_, std::string(failure) + " (" + reason.data() + "); save it again");
  }
  /// Comes first. \return width and height, checked
  glm::ivec2 readHeader(std::span<const std::byte> encoded) {
    run("has no valid header", [&] {
      jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(encoded.data()), encoded.size());
      jpeg_read_header(&info_, TRUE);
    });
    checkImageSize(info_.image_width, info_.image_height, encoded.size(), kJpegPixelsPerByte, name_);
    return {info_.image_width, info_.image_height};
  }
  jpeg_decompress_struct& info() { return info_; }
  /// The first thing that was wrong and passed over; "" if nothing was.
  std::string warning() const { return warning_.data(); }

 private:
  static constexpr int kFatal = 1, kTooManyScans = 2;
  static Decompressor& of(j_common_ptr info) { return *static_cast<Decompressor*>(info->client_data); }

  const std::string& name_;
  jpeg_decompress_struct info_{};
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr progress_{};
  std::jmp_buf back_{};
  std::array<char, JMSG_LENGTH_MAX> warning_{};
};

/// As Adobe's programs store it: what each ink leaves of the light.
void cmykToRgb(ImageRgba8& image) {
  for (auto& pixel : image) {
    const int k = pixel.w;
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>((pixel[c] * k + 127) / 255);
    pixel.w = 255;
  }
}

}  // namespace

bool isJpeg(std::span<const std::byte> encoded) {
  return encoded.size() >= 3 && encoded[0] == std::byte{0xff} && encoded[1] == std::byte{0xd8} &&
         encoded[2] == std::byte{0xff};
}

glm::ivec2 jpegSize(std::span<const std::byte> encoded, const std::string& name) {
  return Decompressor(name).readHeader(encoded);
}

ImageRgba8 decodeJpeg8(std::span<const std::byte> encoded, const std::string& name, std::string* damage) {
  Decompressor decompressor(name);
  const glm::ivec2 size = decompressor.readHeader(encoded);
  jpeg_decompress_struct& info = decompressor.info();
  const bool isCmyk = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
  info.out_color_space = isCmyk ? JCS_CMYK : JCS_EXT_RGBA;
  ImageRgba8 image(size.x, size.y);
  decompressor.run("cannot be decoded", [&] {
    jpeg_start_decompress(&info);
    while (info.output_scanline < info.output_height) {
      auto* row = reinterpret_cast<unsigned char*>(&image.at(0, static_cast<int>(info.output_scanline)));
      jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
  });
  if (damage) *damage = decompressor.warning();
  if (isCmyk) cmykToRgb(image);
  return image;
}

}  // namespace cellcut
