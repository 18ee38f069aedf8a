#include "scene/mesh_bytes.h"

#include <cassert>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace gnomon {
namespace {

template <class Value>
constexpr bool isPlain = std::is_trivially_copyable_v<Value>;

/// Appends values to bytes; Source takes them from there. What they have in common is the walk below.
class Sink {
  public:
    explicit Sink(std::string& bytes) : m_bytes(bytes) {}

    template <class Value>
    void raw(Value* values, std::size_t count) {
        m_bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
    }
    template <class List>
    void size(List& list) {
        std::uint64_t count = list.size();
        raw(&count, 1);
    }

  private:
    std::string& m_bytes;
};

class Source {
  public:
    explicit Source(std::string_view bytes) : m_bytes(bytes) {}

    template <class Value>
    void raw(Value* values, std::size_t count) {
        assert(m_bytes.size() >= count * sizeof(Value));
        // memcpy() takes no null pointer, not even of nothing.
        if (count > 0) std::memcpy(values, m_bytes.data(), count * sizeof(Value));
        m_bytes.remove_prefix(count * sizeof(Value));
    }
    template <class List>
    void size(List& list) {
        std::uint64_t count = 0;
        raw(&count, 1);
        list.resize(count);
    }

  private:
    std::string_view m_bytes;
};

template <class Stream, class Value>
void pass(Stream& stream, Value& value) requires isPlain<Value> {
    stream.raw(&value, 1);
}

template <class Stream>
void pass(Stream& stream, std::string& text) {
    stream.size(text);
    stream.raw(text.data(), text.size());
}

template <class Stream, class Value>
void pass(Stream& stream, std::vector<Value>& list) requires isPlain<Value> {
    stream.size(list);
    stream.raw(list.data(), list.size());
}

template <class Stream>
void pass(Stream& stream, Object& object) {
    pass(stream, object.name);
    pass(stream, object.mesh.positions), pass(stream, object.mesh.triangles);
    pass(stream, object.colour);
    pass(stream, object.casts), pass(stream, object.twoSided);
}

template <class Stream, class Value>
void pass(Stream& stream, std::vector<Value>& list) requires(!isPlain<Value>) {
    stream.size(list);
    for (Value& value : list) pass(stream, value);
}

template <class Stream>
void pass(Stream& stream, MeshFile& mesh) {
    pass(stream, mesh.objects);
    pass(stream, mesh.lights), pass(stream, mesh.cameras);
    pass(stream, mesh.isGltf);
    pass(stream, mesh.notes);
    pass(stream, mesh.dropped.repeatedVertex), pass(stream, mesh.dropped.flat);
}

}  // namespace

std::string toBytes(MeshFile mesh) {
    std::string bytes;
    Sink sink(bytes);
    pass(sink, mesh);
    return bytes;
}

MeshFile meshFileFrom(std::string_view bytes) {
    MeshFile mesh;
    Source source(bytes);
    pass(source, mesh);
    return mesh;
}

}  // namespace gnomon
