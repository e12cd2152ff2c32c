;; Emacs with eglot, which is part of it from 29 on: in init.el. M-x eglot in a card or a program starts the server.
(define-derived-mode flatlang-mode prog-mode "FlatLang"
  (setq-local comment-start ";"))
(add-to-list 'auto-mode-alist '("\\.fl\\'" . flatlang-mode))
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs '((nxml-mode flatlang-mode) . ("popupc" "lsp"))))
