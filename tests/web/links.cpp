// What the page in the browser is made of, linked alone: a source that is missing from its list shows here.
int main() {
  return 0;
}
