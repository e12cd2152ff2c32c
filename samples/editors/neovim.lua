-- Neovim, from 0.7 on: in init.lua, or `luafile samples/editors/neovim.lua`. No plugin is needed.
vim.filetype = vim.filetype or {}
if vim.filetype.add then vim.filetype.add({ extension = { fl = 'flatlang' } }) end
vim.api.nvim_create_autocmd('FileType', {
  pattern = { 'xml', 'flatlang' },
  callback = function(args)
    local client = vim.lsp.start_client({
      name = 'popupc',
      cmd = { vim.env.POPUPC or 'popupc', 'lsp' },
      root_dir = vim.fn.getcwd(),
    })
    vim.lsp.buf_attach_client(args.buf, client)
  end,
})
