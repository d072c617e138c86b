#include "client/render/gl/gpu_timers.h"

#include "client/render/gl/gl.h"

namespace scree {

struct GpuTimers::Queries {
  std::array<GLuint, frames * parts_max * 2> names{};

  Queries() { glGenQueries(static_cast<GLsizei>(names.size()), names.data()); }
  ~Queries() { glDeleteQueries(static_cast<GLsizei>(names.size()), names.data()); }
  GLuint begin(size_t frame, size_t part) const { return names[(frame * parts_max + part) * 2]; }
  GLuint end(size_t frame, size_t part) const { return names[(frame * parts_max + part) * 2 + 1]; }
};

namespace {

/// Desktop GL and ES differ in the names alone.
void mark(GLuint query) {
  epoxy_is_desktop_gl() ? glQueryCounter(query, GL_TIMESTAMP) : glQueryCounterEXT(query, GL_TIMESTAMP_EXT);
}

int64_t time_of(GLuint query) {
  GLuint64 ns = 0;
  epoxy_is_desktop_gl() ? glGetQueryObjectui64v(query, GL_QUERY_RESULT, &ns)
                        : glGetQueryObjectui64vEXT(query, GL_QUERY_RESULT_EXT, &ns);
  return static_cast<int64_t>(ns);
}

bool is_ready(GLuint query) {
  GLuint ready = 0;
  glGetQueryObjectuiv(query, GL_QUERY_RESULT_AVAILABLE, &ready);
  return ready != 0;
}

bool has_timestamps() {
  return epoxy_is_desktop_gl() || epoxy_has_gl_extension("GL_EXT_disjoint_timer_query");
}

int64_t now_on_gpu_ns() {
  GLint64 ns = 0;
  epoxy_is_desktop_gl() ? glGetInteger64v(GL_TIMESTAMP, &ns) : glGetInteger64v(GL_TIMESTAMP_EXT, &ns);
  return ns;
}

}  // namespace

GpuTimers::GpuTimers() : available_(has_timestamps()) {
  if (!available_) return;
  queries_ = std::make_unique<Queries>();
  epoch_ = Trace::Clock::now();
  gpu_epoch_ns_ = now_on_gpu_ns();
}

GpuTimers::~GpuTimers() = default;

void GpuTimers::begin_frame(Trace* trace) {
  if (!available_) return;
  // The oldest first; the one about to be overwritten drops its missing results.
  for (size_t i = 1; i <= frames; ++i) collect((current_ + i) % frames, trace);
  current_ = (current_ + 1) % frames;
  frames_[current_].names.clear();
}

void GpuTimers::collect(size_t frame, Trace* trace) {
  std::vector<std::string_view>& names = frames_[frame].names;
  if (names.empty()) return;
  for (size_t i = 0; i < names.size(); ++i)
    if (!is_ready(queries_->end(frame, i))) return;
  latest_.clear();
  for (size_t i = 0; i < names.size(); ++i) {
    const int64_t begin_ns = time_of(queries_->begin(frame, i));
    const double ms = static_cast<double>(time_of(queries_->end(frame, i)) - begin_ns) / 1.0e6;
    latest_.push_back({names[i], ms});
    if (trace != nullptr)
      trace->span("GPU", names[i], epoch_ + std::chrono::nanoseconds(begin_ns - gpu_epoch_ns_), ms);
  }
  names.clear();
}

GpuTimers::Part::Part(GpuTimers* timers, std::string_view name)
    : timers_(timers != nullptr && timers->available_ ? timers : nullptr) {
  if (timers_ == nullptr) return;
  std::vector<std::string_view>& names = timers_->frames_[timers_->current_].names;
  if (names.size() == parts_max) {
    timers_ = nullptr;
    return;
  }
  at_ = names.size();
  names.push_back(name);
  mark(timers_->queries_->begin(timers_->current_, at_));
}

GpuTimers::Part::~Part() {
  if (timers_ != nullptr) mark(timers_->queries_->end(timers_->current_, at_));
}

}  // namespace scree
