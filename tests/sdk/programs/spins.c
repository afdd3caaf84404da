// Never waits for a blank.
int main(void) {
  for (volatile int i = 0;; ++i) {
  }
}
