// encodeExr of image_io.h.
#include "renderer/base/image_io.h"

#include <algorithm>
#include <cassert>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace cellcut {

namespace {

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : OStream("memory") {}

  void write(const char c[], int n) override {
    const std::size_t end = at_ + static_cast<std::size_t>(n);
    if (end > bytes_.size()) bytes_.resize(end);
    std::copy_n(reinterpret_cast<const std::byte*>(c), n, bytes_.data() + at_);
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

std::string channelName(const ImageLayer& layer, const std::string& channel) {
  return layer.name.empty() ? channel : layer.name + "." + channel;
}

}  // namespace

std::vector<std::byte> encodeExr(const LayeredImage& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, value] : image.metadata) header.insert(key, Imf::StringAttribute(value));

  Imf::FrameBuffer frame;
  for (const ImageLayer& layer : image.layers) {
    const std::size_t pixelBytes = layer.channels.size() * sizeof(float);
    assert(layer.values.size() * sizeof(float) ==
           pixelBytes * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (std::size_t c = 0; c < layer.channels.size(); ++c) {
      const std::string name = channelName(layer, layer.channels[c]);
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      // The frame buffer is one for reading and writing; an output file only reads it.
      char* base = reinterpret_cast<char*>(const_cast<float*>(layer.values.data() + c));
      frame.insert(name, Imf::Slice(Imf::FLOAT, base, pixelBytes, pixelBytes * static_cast<std::size_t>(image.width)));
    }
  }

  MemoryOutput output;
  {
    Imf::OutputFile file(output, header, 0);  // compress on this thread; the destructor writes the table of offsets
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  }
  return output.take();
}

}  // namespace cellcut
