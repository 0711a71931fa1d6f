#include "micro/micro.h"

int main(int argc, char** argv) {
  return bench::runMicro(argc, argv);
}
