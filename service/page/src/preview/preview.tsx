/** The film on a shape. */

export function Preview() {
  return (
    <section aria-labelledby="preview-title">
      <h2 id="preview-title">Preview</h2>
      <div class="awaited-preview" />
    </section>
  );
}
