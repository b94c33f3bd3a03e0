// @ts-check
// A classic script in the head: it sets the stored theme before the first paint.
(() => {
  const key = "rths.theme";
  const root = document.documentElement;
  const kept = localStorage.getItem(key);
  if (kept === "light" || kept === "dark") root.dataset.theme = kept;

  const dark = () => (root.dataset.theme ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
  const announce = () => document.dispatchEvent(new Event("themechange"));

  document.addEventListener("DOMContentLoaded", () => {
    const button = document.getElementById("theme");
    if (!button) return;
    const label = () => (button.textContent = dark() ? "Light theme" : "Dark theme");
    label();
    button.addEventListener("click", () => {
      root.dataset.theme = dark() ? "light" : "dark";
      localStorage.setItem(key, root.dataset.theme);
      label();
      announce();
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      label();
      announce();
    });
  });
})();
