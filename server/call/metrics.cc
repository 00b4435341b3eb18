#include "server/call/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <sstream>

namespace plenum::server {

struct Metrics::Impl {
  prometheus::Registry registry;
  prometheus::Family<prometheus::Counter>& requests = prometheus::BuildCounter()
                                                          .Name("plenum_http_requests_total")
                                                          .Help("Requests answered.")
                                                          .Register(registry);
  prometheus::Family<prometheus::Histogram>& seconds =
      prometheus::BuildHistogram()
          .Name("plenum_http_request_seconds")
          .Help("From the last byte of a request to the answer.")
          .Register(registry);
  prometheus::Counter& bytes_in = prometheus::BuildCounter()
                                      .Name("plenum_http_received_body_bytes_total")
                                      .Help("Bytes of bodies received.")
                                      .Register(registry)
                                      .Add({});
  prometheus::Counter& bytes_out = prometheus::BuildCounter()
                                       .Name("plenum_http_sent_body_bytes_total")
                                       .Help("Bytes of bodies sent, without streams.")
                                       .Register(registry)
                                       .Add({});
};

Metrics::Metrics() : impl_(std::make_unique<Impl>()) {}
Metrics::~Metrics() = default;

void Metrics::Count(const std::string& method, const std::string& route, int status, double seconds,
                    std::size_t bytes_in, std::size_t bytes_out) {
  static const prometheus::Histogram::BucketBoundaries kBuckets = {
      0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 1, 2.5, 10};
  impl_->requests.Add({{"method", method}, {"route", route}, {"status", std::to_string(status)}})
      .Increment();
  impl_->seconds.Add({{"route", route}}, kBuckets).Observe(seconds);
  impl_->bytes_in.Increment(static_cast<double>(bytes_in));
  impl_->bytes_out.Increment(static_cast<double>(bytes_out));
}

void Metrics::Set(const std::string& name, const std::string& help, double value) {
  prometheus::BuildGauge().Name(name).Help(help).Register(impl_->registry).Add({}).Set(value);
}

std::string Metrics::Text() const {
  std::ostringstream text;
  prometheus::TextSerializer().Serialize(text, impl_->registry.Collect());
  return text.str();
}

}  // namespace plenum::server
